"""Compares two robots part by part: links, masses, joints, frames and placement."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from functools import partial
from typing import TypeVar

from twinform.compiler.compare.alignment import Alignment, align
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
from twinform.compiler.compare.matching import compare_leaves, compare_parts
from twinform.compiler.compare.readers import Memo
from twinform.compiler.compare.robot_builder import joint_type
from twinform.ir.frames import WORLD
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform

Named = TypeVar("Named", ComparedBody, JointView)
_SHARED = "inertial/inertia"
"""The values that depend on several links: those of one body may share its inertia in different ways."""
_ABOUT_A_LINE = frozenset({"revolute", "continuous", "screw", "gearbox"})
_ABOUT_A_POINT = frozenset({"ball", "universal", "revolute2"})
"""Joints that have a place on an axis or at a point; others only have directions."""


class RobotComparison:
    """The comparison of two robots as one reader sees them; `memo` has the results of the reader before."""

    def __init__(self, a: ComparedRobot, b: ComparedRobot, terms: Terms, memo: Memo, *, several: bool) -> None:
        lumped = self.lumped = lump(a, b)
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
    away = (other[0] - one[0], other[1] - one[1], other[2] - one[2])
    found = (_distance(each, away, to) for each, to in ((a, base.a), (b, base.b)))
    off = max((distance for distance in found if distance is not None), default=None)
    # none where the frames are only turned, or where the joints slide
    return [] if off is None else [replace(gap, absolute=off, aspect="") for gap in gaps(Point(one), Point(other))]


def _distance(joint: JointView, away: Vector3, base: Transform) -> float | None:
    """Return how far a point is from the axis or center of a joint; None for a joint that slides."""
    if joint.type in _ABOUT_A_LINE and joint.axes:
        axis = UnitVector(joint.axes[0]).seen_from(base).xyz
        along = sum(part * share for part, share in zip(away, axis, strict=True))
        return math.hypot(*(away[i] - along * axis[i] for i in range(3)))
    return math.hypot(*away) if joint.type in _ABOUT_A_POINT else None


def _list_amounts(gaps: Iterable[Delta]) -> str:
    return ", ".join(f"{gap.absolute:.3g} {gap.unit}" for gap in gaps)


def _is_held_by_world(robot: ComparedRobot) -> bool:
    """Whether a robot is fixed to the world."""
    static = robot.leaves.get("static")
    held = any(WORLD in (joint.parent, joint.child) for joint in robot.joints.values())
    return held or (static is not None and static.value == Flag(True))
