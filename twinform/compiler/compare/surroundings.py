"""What is around the models of a file: worlds and what is in them, and parts beside them; and how two files compare."""

from collections.abc import Iterable, Iterator, Mapping
from functools import partial

from twinform.compiler.compare.compared_robot import Leaves, LinkPart
from twinform.compiler.compare.comparison import (
    Base,
    ComparedSubject,
    ComparisonFindings,
    Difference,
    Terms,
)
from twinform.compiler.compare.matching import compare_leaves, compare_parts
from twinform.compiler.compare.part_reader import PartReader
from twinform.dataclass import dataclass
from twinform.diagnostics import Source
from twinform.ir import Document, Frame, Joint, Pose, World
from twinform.ir.frames import WORLD, FrameGraph
from twinform.ir.transform import Transform

_FILE = ""
"""The key for the parts of a file that are in no world and no model."""


@dataclass(frozen=True, slots=True)
class WorldSurroundings:
    """A world without its models, or, with an empty name, the parts of a file that are in no world and no model."""

    name: str
    leaves: Leaves
    parts: tuple[LinkPart, ...]
    where: Source | None

    @property
    def subject(self) -> ComparedSubject:
        """The subject of its differences."""
        return ComparedSubject("world", self.name) if self.name else ComparedSubject("file", "")


def read_surroundings(document: Document) -> dict[str, WorldSurroundings]:
    """Read the worlds of a document in the newest SDF version by name, and the parts beside them."""
    found = {world.name: _read_world(world) for world in document.worlds}
    beside = _read_beside_worlds(document)
    return {**found, _FILE: beside} if beside.parts or beside.leaves else found


def _read_world(world: World) -> WorldSurroundings:
    graph = FrameGraph(world)
    reader = PartReader(partial(_place_in_world, graph))
    leaves, parts = reader.parts(world, Transform())
    members = (*(_read_member(reader, graph, each) for each in (*world.frames, *world.joints)),)
    return WorldSurroundings(world.name, leaves, (*parts, *members), world.source)


def _read_beside_worlds(document: Document) -> WorldSurroundings:
    reader = PartReader(lambda pose, holder: holder.compose(Transform.from_pose(pose)))
    leaves, parts = reader.parts(document, Transform())
    return WorldSurroundings(_FILE, leaves, parts, document.source)


def _read_member(reader: PartReader, graph: FrameGraph, node: Frame | Joint) -> LinkPart:
    """Read a frame or joint of a world, with its pose in the world; a frame with the link that it moves with."""
    kind = "frame" if isinstance(node, Frame) else "joint"
    there = graph.pose(node.name, WORLD, kind=kind, base="world")
    opaque = tuple(part for part in node.opaque if part.name != "<pose>")  # a second one, which no reader looks at
    update: dict[str, object] = {"pose": None, "opaque": opaque}
    if isinstance(node, Frame):
        body = graph.body(node.name, kind=kind)
        update["attached_to"] = None if body == WORLD else body
    return reader.part(node.copy(**update), kind, there)


def _place_in_world(graph: FrameGraph, pose: Pose, holder: Transform) -> Transform:
    if pose.relative_to:
        holder = graph.pose(pose.relative_to, WORLD, kind="joint", base="world")
    return holder.compose(Transform.from_pose(pose))


def compare_surroundings(
    a: Mapping[str, WorldSurroundings], b: Mapping[str, WorldSurroundings], terms: Terms
) -> Iterator[Difference]:
    """Yield the differences between the worlds of two files; a note where only one file has worlds.

    If each file has a single world, the two are compared whatever their names are.
    """
    findings = ComparisonFindings(terms)
    for one, other in _pairs(a, b):
        if one is not None and other is not None:
            _compare_worlds(findings, one, other)
        elif (only := one or other) is not None:
            _report_one_sided(findings, only, in_a=one is not None, counts=bool(a and b))
    yield from findings.items


def _pairs(
    a: Mapping[str, WorldSurroundings], b: Mapping[str, WorldSurroundings]
) -> Iterable[tuple[WorldSurroundings | None, WorldSurroundings | None]]:
    lone_a, lone_b = ([each for each in found.values() if each.name] for found in (a, b))
    if len(lone_a) == len(lone_b) == 1:
        yield lone_a[0], lone_b[0]
        yield a.get(_FILE), b.get(_FILE)
        return
    for name in dict.fromkeys((*a, *b)):
        yield a.get(name), b.get(name)


def _compare_worlds(findings: ComparisonFindings, a: WorldSurroundings, b: WorldSurroundings) -> None:
    places, terms = (a.where, b.where), findings.terms
    if a.name != b.name:
        message = f"the world is called {a.name!r} in {terms.a}, and {b.name!r} in {terms.b}"
        findings.add_note(a.subject, "name", message, places)
    compare_leaves(findings, a.subject, a.leaves, b.leaves, Base(), places)
    compare_parts(findings, a.subject, a.parts, b.parts, Base())


def _report_one_sided(findings: ComparisonFindings, only: WorldSurroundings, *, in_a: bool, counts: bool) -> None:
    if counts:
        findings.add_one_sided(only.subject, "", "world", only.where, in_a=in_a)
        return
    file = findings.terms.a if in_a else findings.terms.b
    what = f"world {only.name!r}" if only.name else "what stands beside the models"
    findings.add_note(only.subject, "", f"{what} is only in {file}, and was not compared", (only.where, only.where))
