"""Selecting the model that becomes the robot."""

from collections import defaultdict
from collections.abc import Callable, Collection, Iterator
from typing import ClassVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.ir import Document, Element, Format, Include, Model, Node, Opaque, World, count_parts
from twinform.ir.frames import WORLD, FrameError, FrameGraph
from twinform.passes.framework.pass_base import Pass
from twinform.passes.legalise.to_mjcf.named_assets import NamedAssets, without_assets
from twinform.passes.shared.candidates import ModelCandidate, candidates


class SelectModel(Pass):
    """Take one model out of a file, and its world away.

    Changes: the document has the model named by `model` (or `world::model`), or the only one there is, and nothing
    else. A pose in a frame of the world becomes a pose in the world. The model keeps the meshes and materials of MJCF
    that it names.
    Diagnostics: `model-not-chosen`, `include-not-expanded`; in the ledger `outside-model` for each part left out.
    """

    name: ClassVar[str] = "select-model"

    model: str | None = None

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with one model."""
        if sink.has_errors:
            return document
        chosen = _choose(list(candidates(document)), self.model, document.location, sink)
        if chosen is None or document.format is Format.URDF:
            return document  # which is that model, and nothing else
        alone = _keep_only(document, chosen, FrameGraph, sink)
        for part in _parts_outside(document, chosen):
            part.drop(sink)
        return alone


class Selector:
    """Selects many models of one file without listing all models each time, as `SelectModel` does."""

    def __init__(self, document: Document) -> None:
        self.document = document
        self.among = list(candidates(document))
        # the frames of a world are resolved once, not for each of its models
        self._graphs: dict[int, FrameGraph] = {}
        self._by_name: defaultdict[str | None, list[ModelCandidate]] = defaultdict(list)
        for one in self.among:
            for name in {one.model.name, one.full_name}:
                self._by_name[name].append(one)

    def select(self, name: str | None, sink: DiagnosticSink) -> Document:
        """The document with one model; the ledger does not list the others."""
        # A world with thousands of models is taken apart model by model; looking each up among all
        # others takes quadratic time.
        called = self._by_name.get(name, [])
        among = called if len(called) == 1 else self.among
        chosen = _choose(among, name, self.document.location, sink)
        if chosen is None or self.document.format is Format.URDF:
            return self.document
        return _keep_only(self.document, chosen, self._graph_of, sink)

    def _graph_of(self, world: World) -> FrameGraph:
        if id(world) not in self._graphs:
            self._graphs[id(world)] = FrameGraph(world)
        return self._graphs[id(world)]


def _keep_only(
    document: Document, chosen: "_Chosen", graph_of: Callable[[World], FrameGraph], sink: DiagnosticSink
) -> Document:
    """The document with nothing but the chosen model, at its place in the world."""
    model, world = chosen.model, chosen.world
    if world is not None:
        model = NamedAssets.of(world).with_model(_place_in_world(model, world, graph_of, sink))
    return document.copy(models=(model,), worlds=(), lights=(), includes=(), opaque=())


@dataclass(frozen=True, slots=True)
class _Chosen:
    model: Model
    world: World | None


@dataclass(frozen=True, slots=True)
class _CarriedPart:
    what: str
    location: Location
    weight: int

    def drop(self, sink: DiagnosticSink) -> None:
        message = f"{self.what} is not part of the robot"
        sink.account(Fate.DROPPED, rules.OUTSIDE_MODEL, message, self.location, self.weight)


def _choose(among: list[ModelCandidate], name: str | None, where: Location, sink: DiagnosticSink) -> _Chosen | None:
    found = [one for one in among if one.answers_to(name)]
    if len(found) != 1:
        _report_choice(among, name, len(found), where, sink)
        return None
    model, world = found[0].model, found[0].world
    if isinstance(model, Include):
        message = f"the model is in {model.uri!r}, which was not read"
        sink.report(rules.INCLUDE_NOT_EXPANDED, message, model.location, found=model.uri)
        return None
    return _Chosen(model, world)


def _report_choice(
    among: list[ModelCandidate], name: str | None, count: int, where: Location, sink: DiagnosticSink
) -> None:
    names, advice = ", ".join(one.full_name for one in among) or "none", None
    if not among:
        message = "there is no model in the file"
    elif name is None:
        message = f"there are {count} models, and a URDF file holds one robot; choose one of {names}"
        # The one with the most joints is probably the robot, and the others furniture.
        advice = f"--model '{max(among, key=_count_joints).full_name}' takes that one"
    else:
        message = f"{count or 'no'} models are called {name!r}; there are {names}"
    related = tuple(one.model.location for one in among[:5])
    sink.report(rules.MODEL_NOT_CHOSEN, message, where, found=name, expected=names, help=advice, related=related)


def _count_joints(one: ModelCandidate) -> int:
    return len(one.model.joints) if isinstance(one.model, Model) else 0


def _place_in_world(model: Model, world: World, graph_of: Callable[[World], FrameGraph], sink: DiagnosticSink) -> Model:
    """The model with its pose in the world."""
    pose = model.pose
    if pose is None or not pose.relative_to:
        return model
    try:
        placed = graph_of(world).resolve(pose, WORLD, WORLD)
    except FrameError as error:
        error.report(sink)
        return model
    message = f"the pose of model {model.name!r} is relative to {pose.relative_to!r}, which is not part of the robot"
    sink.account(Fate.DROPPED, rules.OUTSIDE_MODEL, message, pose.location)
    return model.copy(pose=placed.to_pose())


def _parts_outside(document: Document, chosen: _Chosen) -> Iterator[_CarriedPart]:
    yield from _opaque_parts(document)
    for field in ("models", "lights", "includes"):
        yield from _node_parts(getattr(document, field), field, chosen.model)
    for world in document.worlds:
        if world is not chosen.world:
            yield _CarriedPart(f"world {world.name!r}", world.location, count_parts(world))
            continue
        yield _CarriedPart(f"world {world.name!r} around the model", world.location.at("@name"), 2)
        yield from _opaque_parts(world, NamedAssets.of(world).named_in(chosen.model))
        if world.gravity is not None:
            yield _CarriedPart("<gravity> of the world", world.location.at("gravity"), 1)
        for field in ("models", "includes", "lights", "frames", "joints", "plugins"):
            yield from _node_parts(getattr(world, field), field, chosen.model)


def _node_parts(nodes: tuple[Node, ...], field: str, chosen: Model) -> Iterator[_CarriedPart]:
    for node in nodes:
        if node is not chosen:
            name = getattr(node, "name", None) or getattr(node, "uri", None)
            yield _CarriedPart(f"{field[:-1]} {name!r}", node.location, count_parts(node))


def _opaque_parts(node: Node, assets: Collection[Element] = ()) -> Iterator[_CarriedPart]:
    """Yield the untyped parts of a document or world, without assets that go with the model."""
    for part in node.opaque:
        left = without_assets(part, assets)
        if left is not None:
            yield _CarriedPart(_describe(part), part.location_in(node), left.weight)


def _describe(part: Opaque) -> str:
    name = part.element.get("name") if part.element else None
    return f"{part.name} {name!r}" if name else part.name
