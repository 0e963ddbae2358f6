"""Frame alignment: finds the frame in which a link's contents are compared, so that a moved parent is reported once.

A file may put the frame of a link anywhere: on its joint, as URDF does, or elsewhere. So contents are compared in a
frame that both files have: the frame of the joint that carries the link. If that joint is at another place in the
second file, there are two explanations. Either the link moved along, and its contents have kept their places in the
joint's frame; or only the joint moved, and the contents have kept their places in the frame of the parent link. The
explanation that leaves fewer differences is taken.
"""

from collections.abc import Iterator, Mapping

from twinform.compiler.compare.compared_robot import ComparedBody, ComparedRobot, JointView
from twinform.compiler.compare.compared_values import Point, PoseValue, Tensor
from twinform.compiler.compare.comparison import Base, Terms
from twinform.compiler.compare.matching import unmatched
from twinform.dataclass import dataclass
from twinform.ir.frames import WORLD
from twinform.ir.motion import spanning_tree

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
        self.bases[name] = self._best_base(name, [follow, stay])
        if self.bases[name] is follow:
            self.moved.add(name)

    def _align_standing(self, name: str) -> None:
        """Find the base of a link without a joint: it may have kept its place in the model, the world or neither."""
        own = Base(self.a.bodies[name].frame, self.b.bodies[name].frame)
        model, world = Base(), self.bases[WORLD]
        base = self.bases[name] = self._best_base(name, [model, world, own])
        if base is own and self.terms.worst(PoseValue(own.a), PoseValue(own.b)):
            self.placed.add(name)

    def _best_base(self, name: str, candidates: list[Base]) -> Base:
        """Return the base that leaves the fewest differences; of several, the first."""
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
        """Return how many contents of a link are elsewhere when seen from a base, and whether its frame is."""
        one, other = self.a.bodies[name], self.b.bodies[name]
        count = sum(1 for _ in unmatched(one.parts, other.parts, self.terms, base))
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
        pairs = [(PoseValue(one.frame), PoseValue(other.frame)) for one, other in joints if other]
        pairs += [(PoseValue(one.pose), PoseValue(other.pose)) for one, other in frames if other]
        return sum(1 for one, other in pairs if self.terms.worst(one, other, base))
