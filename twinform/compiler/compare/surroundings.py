"""What is around the models of a file: the values and parts of its worlds, and what stands beside them."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

from twinform.compiler.compare.collect_differences import Base, ComparedSubject, ComparisonFindings, Terms
from twinform.compiler.compare.compared_robot import Leaves, LinkPart
from twinform.compiler.compare.comparison import Difference
from twinform.compiler.compare.matching import compare_leaves, compare_parts
from twinform.compiler.compare.part_reader import PartReader
from twinform.diagnostics import Source
from twinform.ir import Document, Frame, Joint, Pose, World
from twinform.ir.frames import WORLD, FrameGraph
from twinform.ir.transform import Transform

_FILE = ""
"""The name of what stands beside the worlds."""


@dataclass(frozen=True, slots=True)
class WorldSurroundings:
    """A world without its models; one without a name is what a file has beside its worlds and models."""

    name: str
    leaves: Leaves
    parts: tuple[LinkPart, ...]
    where: Source | None

    @property
    def subject(self) -> ComparedSubject:
        """What findings are about."""
        return ComparedSubject("world", self.name) if self.name else ComparedSubject("file", "")


def read_surroundings(document: Document) -> dict[str, WorldSurroundings]:
    """The worlds of a document by their names, and what stands beside them, of a document in the newest SDF version."""
    found = {world.name: _of_world(world) for world in document.worlds}
    beside = _of_file(document)
    return {**found, _FILE: beside} if beside.parts or beside.leaves else found


def _of_world(world: World) -> WorldSurroundings:
    graph = FrameGraph(world)
    reader = PartReader(partial(_resolve, graph))
    leaves, parts = reader.parts(world, Transform())
    members = (*(_placed(reader, graph, each) for each in (*world.frames, *world.joints)),)
    return WorldSurroundings(world.name, leaves, (*parts, *members), world.source)


def _of_file(document: Document) -> WorldSurroundings:
    reader = PartReader(lambda pose, holder: holder.compose(Transform.from_pose(pose)))
    leaves, parts = reader.parts(document, Transform())
    return WorldSurroundings(_FILE, leaves, parts, document.source)


def _placed(reader: PartReader, graph: FrameGraph, node: Frame | Joint) -> LinkPart:
    """A frame or joint of a world, posed in the world, whatever frame it was posed in."""
    kind = "frame" if isinstance(node, Frame) else "joint"
    there = graph.pose(node.name, WORLD, kind=kind, base="world")
    opaque = tuple(part for part in node.opaque if part.name != "<pose>")  # a second one, which no reader looks at
    return reader.part(node.copy(pose=None, opaque=opaque), kind, there)


def _resolve(graph: FrameGraph, pose: Pose, holder: Transform) -> Transform:
    if pose.relative_to:
        holder = graph.pose(pose.relative_to, WORLD, kind="joint", base="world")
    return holder.compose(Transform.from_pose(pose))


def compare_surroundings(
    a: Mapping[str, WorldSurroundings], b: Mapping[str, WorldSurroundings], terms: Terms
) -> Iterator[Difference]:
    """Everything in which the worlds of two files differ; a note where only one of them has any.

    Two worlds that are the only ones of their files are compared whatever they are called.
    """
    findings = ComparisonFindings(terms)
    for one, other in _pairs(a, b):
        if one is not None and other is not None:
            _compare(findings, one, other)
        elif (only := one or other) is not None:
            _only_in_one(findings, only, in_a=one is not None, counts=bool(a and b))
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


def _compare(findings: ComparisonFindings, a: WorldSurroundings, b: WorldSurroundings) -> None:
    places, terms = (a.where, b.where), findings.terms
    if a.name != b.name:
        message = f"the world is called {a.name!r} in {terms.a}, and {b.name!r} in {terms.b}"
        findings.note(a.subject, "name", message, places)
    compare_leaves(findings, a.subject, a.leaves, b.leaves, Base(), places)
    compare_parts(findings, a.subject, a.parts, b.parts, Base())


def _only_in_one(findings: ComparisonFindings, only: WorldSurroundings, *, in_a: bool, counts: bool) -> None:
    if counts:
        findings.only_in_one(only.subject, "", "world", only.where, in_a=in_a)
        return
    file = findings.terms.a if in_a else findings.terms.b
    what = f"world {only.name!r}" if only.name else "what stands beside the models"
    findings.note(only.subject, "", f"{what} is only in {file}, and was not compared", (only.where, only.where))
