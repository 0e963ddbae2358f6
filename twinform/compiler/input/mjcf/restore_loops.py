"""Joints that close loops, in place of the constraints of MJCF that do: they come back while these hold the same links.

A hinge that closes a loop is two points at which bodies are held together. What a carrier has of it is the whole joint,
which goes to where these points are by now. A joint of a type that no constraint stands for comes back while its links
are there.
"""

from collections.abc import Iterable, Mapping, Sequence
from math import dist
from typing import NamedTuple

from twinform.compiler.input.mjcf.carried_texts import report_stale
from twinform.compiler.input.mjcf.number_lists import numbers_of
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Joint, Model, Opaque, Pose
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph, Kind
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform, rounded
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.carriers.mjcf_texts import LOOP
from twinform.passes.carriers.partial_nodes import REST, WRITTEN, written_names
from twinform.passes.legalise.to_mjcf.equalities import ARM, held_points, is_held_in_mjcf
from twinform.passes.legalise.to_mjcf.kept_mjcf import KEPT
from twinform.schemas import XmlElement

Ends = tuple[str | None, str | None]
_CLOSE = 1e-5
"""How far apart two points may be that are one, in m: programs that save MJCF write six digits."""


class LoopsBack(NamedTuple):
    """A model with the joints that closed loops, and the names of the constraints that these stand for."""

    model: Model
    names: frozenset[str]


class NamesByFile(NamedTuple):
    """The names that links and joints have in a model, by those of their bodies, joints and constraints in the file."""

    links: Mapping[str, str]
    joints: Mapping[str, str]
    frames: frozenset[str] = frozenset()
    """The names of frames without sites, such as those of nested models, which the model does not have yet."""


def is_loop(partial: Joint) -> bool:
    """Whether a partial joint closed a loop."""
    return find_annotation(partial, LOOP) is not None


def loops_back(
    model: Model, loops: Iterable[Joint], names: NamesByFile, root: XmlElement, sink: DiagnosticSink
) -> LoopsBack:
    """Put joints that closed loops in place of the constraints that do, if these still do."""
    loops = tuple(loops)
    if not loops:
        return LoopsBack(model, frozenset())
    constraints = _Constraints(model, loops, names, root)
    closed = constraints.closed()
    opened = [name for each in closed for name in written_names(each)]
    found = {each.name for each in closed}
    for each in loops:
        if each.name not in found:
            report_stale(sink, f"the loop that joint {each.name!r} closed is another one now", each.source)
    back = tuple(constraints.whole(each) for each in closed)
    gone = {names.joints.get(each, each) for each in opened}
    left = (each for each in model.joints if each.name not in gone)
    return LoopsBack(model.copy(joints=(*left, *back)), frozenset(opened))


class _Constraints:
    """The constraints of a file by their names, with the joints that they were lowered to, if they were."""

    def __init__(self, model: Model, loops: Sequence[Joint], names: NamesByFile, root: XmlElement) -> None:
        self.model, self.loops, self.names = model, loops, names
        self.joints = {each.name: each for each in model.joints}
        self.elements = {each.get("name") or "": each for each in root.iterfind("equality/*")}
        self.links = {WORLD, *names.frames, *(each.name for each in (*model.links, *model.frames))}
        self.graph = FrameGraph(model)

    def closed(self) -> list[Joint]:
        """The joints that still close loops, where these constraints hold their links together."""
        found = [each for each in self.loops if self._hold(each)]
        while (placed := self._placed(found)) != found:  # the pose of one may be in the frame of another
            found = placed
        return found

    def whole(self, joint: Joint) -> Joint:
        """A joint that closes a loop, with what only MJCF says of its constraints."""
        bare = without_annotation(joint, LOOP, REST, WRITTEN)
        return bare.copy(opaque=(*bare.opaque, *_kept(self._joints_of(written_names(joint)))))

    def _joints_of(self, written: Iterable[str]) -> list[Joint]:
        """The joints that constraints were lowered to: those between several trees of bodies are none."""
        found = (self.joints.get(self.names.joints.get(each, each)) for each in written)
        return [each for each in found if each is not None]

    def _hold(self, partial: Joint) -> bool:
        """Whether all constraints that stood for a joint hold its links together, if there were any."""
        if not _is_held(partial):
            is_there = partial.name not in self.joints and {partial.parent, partial.child} <= self.links
            return is_there and (not is_held_in_mjcf(partial) or self._is_in_one_link(partial))
        written = written_names(partial)
        ends: list[Ends] = [(each.parent, each.child) for each in self._joints_of(written)]
        if not ends:
            ends = [self._ends(self.elements[each]) for each in written if each in self.elements]
        return len(ends) == len(written) and set(ends) == {(partial.parent, partial.child)}

    def _is_in_one_link(self, partial: Joint) -> bool:
        """Whether the frames that a joint connects are in one link, as far as the model has them."""
        ends = {self.graph.body(each) for each in (partial.parent, partial.child) if each and self.graph.knows(each)}
        return len(ends) <= 1

    def _placed(self, loops: Sequence[Joint]) -> list[Joint]:
        """Joints where their constraints are, without those that would hold their links together in another way."""
        gone = {self.names.joints.get(name, name) for each in loops for name in written_names(each)}
        tree = (each for each in self.model.joints if each.name not in gone)
        graph = FrameGraph(self.model.copy(joints=(*tree, *loops)))
        return [placed for each in loops if (placed := self._at_anchors(each, graph)) is not None]

    def _at_anchors(self, joint: Joint, graph: FrameGraph) -> Joint | None:
        if not _is_held(joint):
            return joint
        found = (_anchor(self.elements.get(each)) for each in written_names(joint))
        anchors = [each for each in found if each is not None]
        return next((each for each in (joint, _moved(joint, anchors)) if _is_at(each, anchors, graph)), None)

    def _ends(self, element: XmlElement) -> Ends:
        first, second = element.get("body1"), element.get("body2")
        return self.names.links.get(first or "", first), self.names.links.get(second or "", second)


def _is_held(partial: Joint) -> bool:
    """Whether constraints stand for a joint; none do for one that connects two frames of one link."""
    found = find_annotation(partial, LOOP)
    return is_held_in_mjcf(partial) and (found is None or found.get("held") != "false")


def _is_at(joint: Joint, anchors: Sequence[Vector3], graph: FrameGraph) -> bool:
    """Whether a joint holds its links together at these points, in the frame of the first of them."""
    parent = joint.parent or MODEL
    base: Kind = "world" if parent == WORLD else "link"

    def place(frame: str | None) -> Transform:
        if frame is not None:
            return graph.pose(frame, parent, kind="joint", base=base)
        return graph.resolve(joint.pose, joint.child or MODEL, parent, base=base)

    try:
        points = held_points(joint, place)
    except FrameError:  # the frame of its pose is gone
        return False
    return len(points) == len(anchors) and all(map(_are_close, points, anchors))


def _anchor(constraint: XmlElement | None) -> Vector3 | None:
    """The point at which a constraint holds bodies together, in the frame of the first; None where it is a weld."""
    if constraint is None or constraint.tag != "connect":
        return None
    x, y, z = numbers_of(constraint, "anchor", (0.0, 0.0, 0.0), count=3) or (0.0, 0.0, 0.0)
    return x, y, z


def _moved(partial: Joint, anchors: Sequence[Vector3]) -> Joint:
    """The joint at the first of these points, with its axis through the second, if there is one."""
    if not anchors:
        return partial
    first, last = anchors[0], anchors[-1]
    moved = partial.copy(pose=Pose.unchecked(xyz=first, relative_to=partial.parent))
    if len(anchors) == 1 or partial.axis is None:
        return moved
    along = rounded(((last[0] - first[0]) / ARM, (last[1] - first[1]) / ARM, (last[2] - first[2]) / ARM))
    return moved.copy(axis=partial.axis.copy(xyz=along, expressed_in=None))


def _are_close(one: Vector3, other: Vector3) -> bool:
    return dist(one, other) <= _CLOSE


def _kept(parts: Iterable[Joint]) -> Iterable[Opaque]:
    """What only MJCF says of the first of the constraints, which are alike."""
    first = next(iter(parts), None)
    opaque = first.opaque if first is not None else ()
    return (part for part in opaque if part.element is not None and part.element.name == KEPT)
