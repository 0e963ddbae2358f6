"""Frame alignment: from which frame a link's contents are compared, so that a moved parent is reported once.

A file may put the frame of a link anywhere: on its joint, as URDF does, or elsewhere. So contents are compared in a
frame that both files have: that of the joint that carries the link. Where that joint is not at the same place in both,
either the link moved with it, and its contents are where they were in the joint's frame; or only the joint is placed at
another place, and the contents are where they were in the frame of the link above. What leaves fewer differences is
what happened.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from twinform.compiler.compare.collect_differences import Base, Terms
from twinform.compiler.compare.compared_robot import ComparedBody, ComparedRobot, JointView
from twinform.compiler.compare.compared_values import Point, PoseValue, Tensor
from twinform.compiler.compare.matching import unmatched
from twinform.ir.frames import WORLD
from twinform.ir.motion import spanning_tree

_NO_MISFIT = (0, False)


@dataclass(frozen=True, slots=True)
class Alignment:
    """The base of every link that both robots have.

    `moved` are those that went along with their joint to another place, `placed` those that stand elsewhere in the
    model or the world.
    """

    bases: Mapping[str, Base]
    moved: frozenset[str]
    placed: frozenset[str]

    def of(self, link: str) -> tuple[Base | None, bool, bool]:
        """All that is known of a link."""
        return self.bases.get(link), link in self.moved, link in self.placed


def align(a: ComparedRobot, b: ComparedRobot, terms: Terms) -> Alignment:
    """A base for every link that both robots have, from the roots on."""
    work = _AlignmentRun(a, b, terms)
    for name in _from_the_roots(a, work.above_a):
        if name in b.bodies:
            work.place(name)
    return Alignment(work.bases, frozenset(work.moved), frozenset(work.placed))


def _from_the_roots(robot: ComparedRobot, above: Mapping[str, JointView]) -> Iterator[str]:
    """The links, each after the one that it hangs from."""
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
            self._hang(name, one, other)
        else:
            self._stand(name)

    def _hang(self, name: str, one: JointView, other: JointView) -> None:
        stay, follow = self.bases[one.parent], Base(one.frame, other.frame)
        if not self.terms.worst(PoseValue(one.frame), PoseValue(other.frame), stay):
            self.bases[name] = follow
            return
        self.bases[name] = self._best(name, [follow, stay])
        if self.bases[name] is follow:
            self.moved.add(name)

    def _stand(self, name: str) -> None:
        """A link that hangs from nothing: the model, the world or its own frame may be what it kept its place in."""
        own = Base(self.a.bodies[name].frame, self.b.bodies[name].frame)
        model, world = Base(), self.bases[WORLD]
        base = self.bases[name] = self._best(name, [model, world, own])
        if base is own and self.terms.worst(PoseValue(own.a), PoseValue(own.b)):
            self.placed.add(name)

    def _best(self, name: str, candidates: list[Base]) -> Base:
        """The first of the bases that leave the fewest differences."""
        best, *others = dict.fromkeys(candidates)
        least = self._misfit(name, best)
        for base in others:
            if least == _NO_MISFIT:  # most links have not moved
                break
            misfit = self._misfit(name, base)
            if misfit < least:
                best, least = base, misfit
        return best

    def _misfit(self, name: str, base: Base) -> tuple[int, int]:
        """How many of the contents are elsewhere, and whether the frame itself is."""
        one, other = self.a.bodies[name], self.b.bodies[name]
        count = sum(1 for _ in unmatched(one.parts, other.parts, self.terms, base))
        count += self._misfit_of_mass(one, other, base) + self._misfit_below(name, base)
        return count, bool(self.terms.worst(PoseValue(one.frame), PoseValue(other.frame), base))

    def _misfit_of_mass(self, one: ComparedBody, other: ComparedBody, base: Base) -> int:
        if not one.mass.solid.mass or not other.mass.solid.mass:
            return 0
        center = self.terms.worst(Point(one.mass.solid.center), Point(other.mass.solid.center), base)
        tensor = self.terms.worst(Tensor(one.mass.solid.inertia), Tensor(other.mass.solid.inertia), base)
        return bool(center) + bool(tensor)

    def _misfit_below(self, name: str, base: Base) -> int:
        joints = [(one, self.b.joints.get(one.name)) for one in self.joints_below.get(name, ())]
        frames = [(self.a.frames[each], self.b.frames.get(each)) for each in self.frames_on.get(name, ())]
        pairs = [(PoseValue(one.frame), PoseValue(other.frame)) for one, other in joints if other]
        pairs += [(PoseValue(one.pose), PoseValue(other.pose)) for one, other in frames if other]
        return sum(1 for one, other in pairs if self.terms.worst(one, other, base))
