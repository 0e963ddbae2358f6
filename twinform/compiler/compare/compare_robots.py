"""Compares two robots part by part: links, masses, joints, frames and placement.

A file may put the frame of a link anywhere: on its joint, as URDF does, or elsewhere. So contents are compared in a
frame that both files have: the frame of the joint that carries the link. If that joint is at another place in the
second file, there are two explanations. Either the link moved along, and its contents have kept their places in the
joint's frame; or only the joint moved, and the contents have kept their places in the frame of the parent link. The
explanation that leaves fewer differences is taken.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from typing import TypeVar

from twinform.compiler.compare.compare_frames import KINEMATICS, compare_frames, compare_kinematics
from twinform.compiler.compare.compared_robot import ComparedBody, ComparedRobot, JointView, Leaves, Mass
from twinform.compiler.compare.compared_values import (
    Delta,
    Flag,
    Numbers,
    Point,
    PoseValue,
    Tensor,
    Text,
    UnitVector,
    Value,
    gaps,
)
from twinform.compiler.compare.comparison import (
    Base,
    ComparedSubject,
    ComparisonFindings,
    Difference,
    DifferenceSeverity,
    Terms,
)
from twinform.compiler.compare.fixed_bodies import FixedBodies, lump
from twinform.compiler.compare.matching import compare_leaves, compare_parts, unmatched
from twinform.compiler.compare.readers import Memo
from twinform.compiler.compare.robot_builder import joint_type
from twinform.compiler.compare.usd_terms import in_common_terms
from twinform.dataclass import dataclass
from twinform.ir.frames import WORLD
from twinform.ir.motion import spanning_tree
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform, across, minus

Named = TypeVar("Named", ComparedBody, JointView)
_SHARED = "inertial/inertia"
"""The values that depend on several links: those of one body may share its inertia in different ways."""
_ABOUT_A_LINE = frozenset({"revolute", "continuous", "screw", "gearbox"})
_ABOUT_A_POINT = frozenset({"ball", "universal", "revolute2"})
"""Joints that have a place on an axis or at a point; others only have directions."""
_WITH_MOTION = _ABOUT_A_LINE | _ABOUT_A_POINT | {"prismatic"}


class RobotComparison:
    """The comparison of two robots as one reader sees them; `memo` has the results of the reader before."""

    def __init__(self, a: ComparedRobot, b: ComparedRobot, terms: Terms, memo: Memo, *, several: bool) -> None:
        lumped = self.lumped = lump(*in_common_terms(a, b))
        self.a, self.b = lumped.a, lumped.b
        self.terms = terms
        self.several = several
        self.memo = memo
        self.subject = ComparedSubject("model", lumped.a.name if several else "")
        self.found = ComparisonFindings(terms, lumped.a.name if several else "")
        self.alignment: Alignment = align(self.a, self.b, terms)
        self.fixed = (FixedBodies(self.a), FixedBodies(self.b))

    def run(self) -> list[Difference]:
        """Return all differences; where the files have `several` robots, their poses in the world count."""
        self._compare_models()
        self._note_lumped()
        self._compare_each("link", self.a.bodies, self.b.bodies, self._compare_bodies)
        self._compare_each("joint", self.a.joints, self.b.joints, self._compare_joints)
        compare_frames(self.found, self.a, self.b, self.alignment.bases)
        moving = (self.alignment.bases, self.a.joints, self.b.joints)
        self._reuse(KINEMATICS, "", moving, self._kinematics)
        return self.found.items

    def _kinematics(self) -> None:
        compare_kinematics(self.found, self.a, self.b, self.alignment.bases)

    def _reuse(self, group: str, name: str, given: object, compare: Callable[[], None]) -> None:
        """Add the differences that a comparison finds, or found before for equal parts."""
        items = self.found.items

        def make() -> list[Difference]:
            start = len(items)
            compare()
            found = items[start:]
            del items[start:]
            return found

        items += self.memo.once((group, name), given, make, _is_independent)

    def _compare_each(
        self, group: str, a: Mapping[str, Named], b: Mapping[str, Named], compare: Callable[[Named, Named], None]
    ) -> None:
        for name, one in a.items():
            if name in b:
                links = (one.name,) if isinstance(one, ComparedBody) else (one.parent, one.child)
                given = one, b[name], tuple(map(self.alignment.of, links))
                self._reuse(group, name, given, partial(compare, one, b[name]))
            else:
                self.found.add_one_sided(ComparedSubject(group, name), "", group, one.where, in_a=True)
        for name, other in b.items():
            if name not in a:
                self.found.add_one_sided(ComparedSubject(group, name), "", group, other.where, in_a=False)

    def _note_lumped(self) -> None:
        both = ((self.lumped.from_a, self.terms.b), (self.lumped.from_b, self.terms.a))
        for into, file in both:
            for name, host in into.items():
                frame = (self.a if file == self.terms.b else self.b).frames[name]
                message = f"link {name!r} is a part of link {host!r} in {file}"
                self.found.add_note(ComparedSubject("link", name), "", message, (frame.where, frame.where))

    def _compare_models(self) -> None:
        places = (self.a.where, self.b.where)
        if self.a.name != self.b.name:
            message = f"the model is called {self.a.name!r} in {self.terms.a}, and {self.b.name!r} in {self.terms.b}"
            self.found.add_note(self.subject, "name", message, places)
        compare_leaves(self.found, self.subject, self.a.leaves, self.b.leaves, Base(), places)
        compare_parts(self.found, self.subject, self.a.parts, self.b.parts, Base())
        self._compare_poses()

    def _compare_poses(self) -> None:
        """Compare where the models stand in the world, unless all their links have moved in the model."""
        bases = [base for name, base in self.alignment.bases.items() if name != WORLD]
        away = self.terms.worst(PoseValue(self.a.world.inverse()), PoseValue(self.b.world.inverse()))
        if not away or (bases and Base() not in bases):
            return
        counts = self.several or _is_held_by_world(self.a) or _is_held_by_world(self.b)
        severity = DifferenceSeverity.DIFFERENCE if counts else DifferenceSeverity.NOTE
        self.found.add_gaps(self.subject, "pose", away, (self.a.where, self.b.where), severity)

    def _compare_bodies(self, a: ComparedBody, b: ComparedBody) -> None:
        subject, base = ComparedSubject("link", a.name), self.alignment.bases[a.name]
        self._compare_masses(subject, a.mass, b.mass, base)
        compare_leaves(self.found, subject, a.leaves, b.leaves, base, (a.where, b.where))
        compare_parts(self.found, subject, a.parts, b.parts, base)
        if a.name in self.alignment.placed:
            self.found.compare_values(subject, "pose", PoseValue(a.frame), PoseValue(b.frame), (a.where, b.where))
            return
        moved = self.terms.worst(PoseValue(a.frame), PoseValue(b.frame), base)
        if moved:
            message = f"link {a.name!r} is expressed in another frame ({_list_amounts(moved)} away)"
            self.found.add_note(subject, "frame", message, (a.where, b.where))

    def _compare_masses(self, subject: ComparedSubject, a: Mass, b: Mass, base: Base) -> None:
        places = (a.where, b.where)
        if a.automatic or b.automatic:
            self.found.compare_values(subject, "inertial/auto", Flag(a.automatic), Flag(b.automatic), places)
            return
        one, other = a.solid, b.solid
        self.found.compare_values(
            subject, "inertial/mass", Numbers((one.mass,), "kg"), Numbers((other.mass,), "kg"), places
        )
        values: list[tuple[str, Value, Value]] = []
        if one.mass or other.mass:
            values.append(("center", Point(one.center), Point(other.center)))
        if any((*one.inertia, *other.inertia)):  # also of what weighs nothing
            values.append(("inertia", Tensor(one.inertia), Tensor(other.inertia)))
        others = [name for name, here, there in values if self.terms.worst(here, there, base)]
        if others and self._is_shared(subject.name, base):
            message = f"{subject} has another {' and '.join(others)}, and with the links that are fixed to it the same"
            self.found.add_note(subject, f"inertial/{others[0]}", message, places)
            return
        for name, here, there in values:
            self.found.compare_values(subject, f"inertial/{name}", here, there, places, base)

    def _is_shared(self, link: str, base: Base) -> bool:
        """Whether the two robots only share the mass of a link's body in different ways: engines see no difference."""
        if not any(bodies.is_shared(link) for bodies in self.fixed):
            return False
        one, other = (bodies.whole(link) for bodies in self.fixed)
        return not (
            self.terms.worst(Numbers((one.mass,), "kg"), Numbers((other.mass,), "kg"), base)
            or self.terms.worst(Point(one.center), Point(other.center), base)
            or self.terms.worst(Tensor(one.inertia), Tensor(other.inertia), base)
        )

    def _compare_joints(self, a: JointView, b: JointView) -> None:
        subject, places = ComparedSubject("joint", a.name), (a.where, b.where)
        for aspect, one, other in (("parent", a.parent, b.parent), ("child", a.child, b.child)):
            self.found.compare_values(subject, aspect, Text(one), Text(other), places)
        one, other = joint_type(a.type), joint_type(b.type)
        self.found.compare_values(subject, "type", Text(one), Text(other), places)
        base = self.alignment.bases.get(a.child, Base())
        if a.parent == b.parent:
            self._compare_joint_places(subject, a, b)
        if one == other:
            for number, pair in enumerate(zip(a.axes, b.axes, strict=False)):
                aspect = "axis2/xyz" if number else "axis/xyz"
                self.found.compare_values(subject, aspect, UnitVector(pair[0]), UnitVector(pair[1]), places, base)
        compare_leaves(self.found, subject, *_common_leaves(a, b), base, places)
        compare_parts(self.found, subject, a.parts, b.parts, base)

    def _compare_joint_places(self, subject: ComparedSubject, a: JointView, b: JointView) -> None:
        base = self.alignment.bases.get(a.parent, Base())
        away = self.terms.worst(PoseValue(a.frame), PoseValue(b.frame), base)
        if not away:
            return
        places = (a.where, b.where)
        if a.child in self.alignment.moved or a.child not in self.alignment.bases:
            self.found.add_gaps(subject, "pose", away, places)
            return
        off = [gap for gap in _gaps_off_axis(a, b, base) if self.terms.differs(gap)]
        self.found.add_gaps(subject, "axis/position", off, places)
        if not off:
            message = (
                f"joint {a.name!r} is defined at another place, which changes nothing ({_list_amounts(away)} away)"
            )
            self.found.add_note(subject, "frame", message, places)


def _is_independent(found: Iterable[Difference]) -> bool:
    """Whether the differences of a link or joint depend on no other link."""
    return not any(item.aspect.startswith(_SHARED) for item in found)


def _common_leaves(a: JointView, b: JointView) -> tuple[Leaves, Leaves]:
    """Return the values of two joints; for joints of different types, only the values that both have."""
    if joint_type(a.type) == joint_type(b.type):
        return a.leaves, b.leaves
    both = a.leaves.keys() & b.leaves.keys()
    one, other = ({path: leaf for path, leaf in each.leaves.items() if path in both} for each in (a, b))
    return one, other


def _gaps_off_axis(a: JointView, b: JointView, base: Base) -> Iterable[Delta]:
    """Return how far the joints are off each other's axis or center: the larger distance, where their axes differ."""
    one, other = (Point(each.frame.translation).seen_from(to).xyz for each, to in ((a, base.a), (b, base.b)))
    away = minus(other, one)
    found = (_distance(each, away, to) for each, to in ((a, base.a), (b, base.b)))
    off = max((distance for distance in found if distance is not None), default=None)
    # none where the frames are only turned, or where the joints slide
    return [] if off is None else [replace(gap, absolute=off, aspect="") for gap in gaps(Point(one), Point(other))]


def _distance(joint: JointView, away: Vector3, base: Transform) -> float | None:
    """Return how far a point is from the axis or center of a joint; None for a joint that slides."""
    if joint.type in _ABOUT_A_LINE and joint.axes:
        return math.hypot(*across(UnitVector(joint.axes[0]).seen_from(base).xyz, away))
    return math.hypot(*away) if joint.type in _ABOUT_A_POINT else None


def _list_amounts(gaps: Iterable[Delta]) -> str:
    return ", ".join(f"{gap.absolute:.3g} {gap.unit}" for gap in gaps)


def _is_held_by_world(robot: ComparedRobot) -> bool:
    """Whether a robot is fixed to the world."""
    static = robot.leaves.get("static")
    held = any(WORLD in (joint.parent, joint.child) for joint in robot.joints.values())
    return held or (static is not None and static.value == Flag(True))


_NO_MISFIT = (0, False)


@dataclass(frozen=True, slots=True)
class Alignment:
    """The base frames of every link that both robots have.

    `moved` has the links that moved together with their joint, and `placed` the links without a joint that stand
    elsewhere in the model or world.
    """

    bases: Mapping[str, Base]
    moved: frozenset[str]
    placed: frozenset[str]

    def of(self, link: str) -> tuple[Base | None, bool, bool]:
        """Return the base of a link, and whether it is `moved` and `placed`."""
        return self.bases.get(link), link in self.moved, link in self.placed


def align(a: ComparedRobot, b: ComparedRobot, terms: Terms) -> Alignment:
    """Find a base for every link that both robots have, starting from the roots."""
    work = _AlignmentRun(a, b, terms)
    for name in _links_from_roots(a, work.above_a):
        if name in b.bodies:
            work.place(name)
    return Alignment(work.bases, frozenset(work.moved), frozenset(work.placed))


def _links_from_roots(robot: ComparedRobot, above: Mapping[str, JointView]) -> Iterator[str]:
    """Yield the names of the links, each after its parent link."""
    seen: set[str] = set()
    for name in robot.bodies:
        path: list[str] = []
        while name in robot.bodies and name not in seen:
            seen.add(name)
            path.append(name)
            name = above[name].parent if name in above else WORLD  # noqa: PLW2901 - the way up
        yield from reversed(path)


class _AlignmentRun:
    def __init__(self, a: ComparedRobot, b: ComparedRobot, terms: Terms) -> None:
        self.a, self.b, self.terms = a, b, terms
        self.above_a, self.above_b = spanning_tree(a.joints.values()), spanning_tree(b.joints.values())
        self.bases: dict[str, Base] = {WORLD: Base(a.world, b.world)}
        self.moved: set[str] = set()
        self.placed: set[str] = set()
        self.joints_below: dict[str, list[JointView]] = {}
        for joint in a.joints.values():
            self.joints_below.setdefault(joint.parent, []).append(joint)
        self.frames_on: dict[str, list[str]] = {}
        for frame in a.frames.values():
            self.frames_on.setdefault(frame.body, []).append(frame.name)

    def place(self, name: str) -> None:
        one, other = self.above_a.get(name), self.above_b.get(name)
        if one and other and one.name == other.name and one.parent == other.parent and one.parent in self.bases:
            self._align_hanging(name, one, other)
        else:
            self._align_standing(name)

    def _align_hanging(self, name: str, one: JointView, other: JointView) -> None:
        stay, follow = self.bases[one.parent], Base(one.frame, other.frame)
        if not self.terms.worst(PoseValue(one.frame), PoseValue(other.frame), stay):
            self.bases[name] = follow
            return
        # A joint at another place is a difference of its own, unless the link moves about it as before.
        known = {follow: 1, stay: int(self._moves_otherwise(one, other, stay))}
        self.bases[name] = self._best_base(name, known)
        if self.bases[name] is follow:
            self.moved.add(name)

    def _align_standing(self, name: str) -> None:
        """Find the base of a link without a joint: it may have kept its place in the model, the world or neither."""
        own = Base(self.a.bodies[name].frame, self.b.bodies[name].frame)
        model, world = Base(), self.bases[WORLD]
        base = self.bases[name] = self._best_base(name, dict.fromkeys((model, world, own), 0))
        if base is own and self.terms.worst(PoseValue(own.a), PoseValue(own.b)):
            self.placed.add(name)

    def _best_base(self, name: str, candidates: Mapping[Base, int]) -> Base:
        """Return the base that leaves the fewest differences beside those that are known; of several, the first."""
        (best, known), *others = candidates.items()
        least = self._misfit(name, best, known)
        for base, known in others:
            if least == _NO_MISFIT:  # most links have not moved
                break
            misfit = self._misfit(name, base, known)
            if misfit < least:
                best, least = base, misfit
        return best

    def _misfit(self, name: str, base: Base, known: int) -> tuple[int, int]:
        """Return how many contents of a link are elsewhere when seen from a base, and whether its frame is."""
        one, other = self.a.bodies[name], self.b.bodies[name]
        count = known + sum(1 for _ in unmatched(one.parts, other.parts, self.terms, base))
        count += self._mass_misfit(one, other, base) + self._misfit_of_children(name, base)
        return count, bool(self.terms.worst(PoseValue(one.frame), PoseValue(other.frame), base))

    def _mass_misfit(self, one: ComparedBody, other: ComparedBody, base: Base) -> int:
        if not one.mass.solid.mass or not other.mass.solid.mass:
            return 0
        center = self.terms.worst(Point(one.mass.solid.center), Point(other.mass.solid.center), base)
        tensor = self.terms.worst(Tensor(one.mass.solid.inertia), Tensor(other.mass.solid.inertia), base)
        return bool(center) + bool(tensor)

    def _misfit_of_children(self, name: str, base: Base) -> int:
        joints = [(one, self.b.joints.get(one.name)) for one in self.joints_below.get(name, ())]
        frames = [(self.a.frames[each], self.b.frames.get(each)) for each in self.frames_on.get(name, ())]
        pairs = [(PoseValue(one.pose), PoseValue(other.pose)) for one, other in frames if other]
        count = sum(1 for one, other in pairs if self.terms.worst(one, other, base))
        return count + sum(1 for one, other in joints if other and self._moves_otherwise(one, other, base))

    def _moves_otherwise(self, one: JointView, other: JointView, base: Base) -> bool:
        """Whether a joint has another axis or center when seen from a base, or another place where it has neither."""
        is_elsewhere = bool(self.terms.worst(PoseValue(one.frame), PoseValue(other.frame), base))
        if joint_type(one.type) != joint_type(other.type) or one.type not in _WITH_MOTION:
            return is_elsewhere
        axes = zip(one.axes, other.axes, strict=False)
        if any(self.terms.worst(UnitVector(here), UnitVector(there), base) for here, there in axes):
            return True
        return is_elsewhere and any(map(self.terms.differs, _gaps_off_axis(one, other, base)))
