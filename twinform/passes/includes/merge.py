"""Merge includes (`merge="true"`): contents of the included model become contents of the model or world around it."""

from dataclasses import dataclass
from typing import TypeVar

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import IN_MODELS, Frame, Include, Link, Model, Node, Pose, ReferenceKind, World
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph
from twinform.ir.transform import Transform
from twinform.passes.includes.place import placed_model
from twinform.passes.transforms.element_poses import map_frames

AnyNode = TypeVar("AnyNode", bound=Node)
Posed = TypeVar("Posed", Link, Model, Include)
Holder = TypeVar("Holder", Model, World)

_SETTINGS = ("static", "self_collide", "allow_auto_disable", "enable_wind")


def merge_into_model(holder: Model, include: Include, model: Model, sink: DiagnosticSink, frame: Transform) -> Model:
    """The model with the contents of another; a frame stands for the other's own frame."""
    return _merged(holder, include, placed_model(include, model, sink, frame), MODEL, sink)


def merge_into_world(holder: World, include: Include, model: Model, sink: DiagnosticSink, frame: Transform) -> World:
    """The world with the models, frames and joints of an included model, which must have no links of its own."""
    if model.links:
        message = f"{include.uri!r} cannot be merged into a world: it has links"
        sink.report(rules.UNMERGEABLE_INCLUDE, message, include.location, found=include.uri)
        return holder
    return _merged(holder, include, placed_model(include, model, sink, frame), WORLD, sink)


def _merged(holder: Holder, include: Include, model: Model, around: str, sink: DiagnosticSink) -> Holder:
    """The holder with the contents of a model in its place; `around` is what its own frame is called."""
    proxy = _proxy(model, around, sink)
    if proxy is None:
        return holder
    into = _Contents(proxy.name)
    _account_settings(model, sink)
    contents: dict[str, tuple[object, ...]] = {
        "links": tuple(map(into.posed, model.links)),
        "joints": tuple(map(into.inside, model.joints)),
        "frames": (proxy, *map(into.frame, model.frames)),
        "models": tuple(map(into.posed, model.models)),
        "includes": tuple(map(into.posed, model.includes)),
        "plugins": model.plugins,
        # Attributes of the included model are its settings, and there is no such model any more.
        "opaque": tuple(part for part in model.opaque if part.element),
    }
    return holder.copy(**{name: (*getattr(holder, name), *parts) for name, parts in contents.items() if parts})


def _proxy(model: Model, around: str, sink: DiagnosticSink) -> Frame | None:
    """The frame that stands for the merged model's own: it moves with its canonical link and is where it was placed."""
    try:
        graph = FrameGraph(model)
        body = graph.body(MODEL, kind="model")
        placed = Transform.from_pose(model.pose)
        if model.placement_frame:
            placed = placed.compose(graph.pose(model.placement_frame, MODEL, kind="frame", base="model").inverse())
    except FrameError as error:
        error.report(sink)
        return None
    base = model.pose.relative_to if model.pose and model.pose.relative_to else around
    attached = None if body == MODEL else body
    # The name is that of libsdformat (Utils.cc, computeMergedModelProxyFrameName), so that a file
    # that names this frame still finds it.
    return Frame(
        name=f"_merged__{model.name}__model__", attached_to=attached, pose=placed.to_pose(base), source=model.source
    )


@dataclass(frozen=True, slots=True)
class _Contents:
    """Parts of a model in which another frame stands for the model's own."""

    proxy: str

    def posed(self, node: Posed) -> Posed:
        """A link, nested model or include; without a frame of its own its pose was in the model's."""
        pose = node.pose or Pose()
        pose = pose.copy(relative_to=self._named("any", pose.relative_to or MODEL))
        placed = node.copy(pose=pose)
        return self.inside(placed) if isinstance(placed, Link) else placed  # what is in a model has frames of its own

    def frame(self, frame: Frame) -> Frame:
        return self.inside(frame.copy(attached_to=frame.attached_to or MODEL))

    def inside(self, node: AnyNode) -> AnyNode:
        """The node with all references in it, and those of untyped poses."""
        return map_frames(node, self._named)

    def _named(self, kind: ReferenceKind, name: str) -> str:
        return self.proxy if name == MODEL and kind in IN_MODELS else name


def _account_settings(model: Model, sink: DiagnosticSink) -> None:
    """What the merged model has as a whole does not count."""
    written = [name for name in _SETTINGS if getattr(model, name) is not None]
    attributes = [part for part in model.opaque if part.element is None]
    for name in (*written, *(part.name for part in attributes)):
        message = f"{name} of the merged model {model.name!r} is left out; that of the model around it is used"
        sink.account(Fate.DROPPED, rules.MERGED_AWAY, message, model.location.at(name))
