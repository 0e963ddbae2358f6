"""Places included models, lights and actors, and merges models (`merge="true"`) into the model or world around them."""

from collections.abc import Iterator
from contextlib import suppress
from typing import TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import (
    IN_MODELS,
    Document,
    Element,
    Format,
    Frame,
    Include,
    Light,
    Link,
    Model,
    Node,
    Opaque,
    Pose,
    ReferenceKind,
    World,
)
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import came_from, find_annotation
from twinform.passes.carriers.carriers import to_element
from twinform.passes.shared.poses import OFFSET, map_frames, read_offset

AnyNode = TypeVar("AnyNode", bound=Node)
Posed = TypeVar("Posed", Link, Model, Include)
Holder = TypeVar("Holder", Model, World)
_SETTINGS = ("static", "self_collide", "allow_auto_disable", "enable_wind")
_PARAMETERS = "params"
"""The local name of `<experimental:params>`."""


def merge_into_model(holder: Model, include: Include, model: Model, sink: DiagnosticSink, frame: Transform) -> Model:
    """The model with the contents of another model, and a frame that stands for the frame of this model."""
    return _merge(holder, include, place_model(include, model, sink, frame), MODEL, sink)


def merge_into_world(holder: World, include: Include, model: Model, sink: DiagnosticSink, frame: Transform) -> World:
    """The world with the models, frames and joints of an included model, which must have no links of its own."""
    if model.links:
        message = f"{include.uri!r} cannot be merged into a world: it has links"
        sink.report(rules.UNMERGEABLE_INCLUDE, message, include.location, found=include.uri)
        return holder
    return _merge(holder, include, place_model(include, model, sink, frame), WORLD, sink)


def _merge(holder: Holder, include: Include, model: Model, around: str, sink: DiagnosticSink) -> Holder:
    """The holder with the contents of a model; `around` is the name of its own frame."""
    proxy = _proxy_frame(model, around, sink)
    if proxy is None:
        return holder
    into = _MovedContents(proxy.name)
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


def _proxy_frame(model: Model, around: str, sink: DiagnosticSink) -> Frame | None:
    """The frame that stands for that of the merged model: placed like it, and moving with its canonical link."""
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
    return Frame.unchecked(
        name=f"_merged__{model.name}__model__", attached_to=attached, pose=placed.to_pose(base), source=model.source
    )


@dataclass(frozen=True, slots=True)
class _MovedContents:
    """Parts of a merged model, in which the proxy stands for the frame of the model."""

    proxy: str

    def posed(self, node: Posed) -> Posed:
        """A link, nested model or include, whose pose was relative to the model by default."""
        pose = node.pose or Pose.unchecked()
        pose = pose.copy(relative_to=self._follow_frame("any", pose.relative_to or MODEL))
        placed = node.copy(pose=pose)
        return self.inside(placed) if isinstance(placed, Link) else placed  # what is in a model has frames of its own

    def frame(self, frame: Frame) -> Frame:
        return self.inside(frame.copy(attached_to=frame.attached_to or MODEL))

    def inside(self, node: AnyNode) -> AnyNode:
        """The node with all references in it, also those of untyped poses."""
        return map_frames(node, self._follow_frame)

    def _follow_frame(self, kind: ReferenceKind, name: str) -> str:
        return self.proxy if name == MODEL and kind in IN_MODELS else name


def _account_settings(model: Model, sink: DiagnosticSink) -> None:
    """Account for settings of the merged model, which have no effect any more."""
    written = [name for name in _SETTINGS if getattr(model, name) is not None]
    attributes = [part for part in model.opaque if part.element is None]
    for name in (*written, *(part.name for part in attributes)):
        message = f"{name} of the merged model {model.name!r} is left out; that of the model around it is used"
        sink.account(Fate.DROPPED, rules.MERGED_AWAY, message, model.location.at(name))


def place_model(include: Include, model: Model, sink: DiagnosticSink, frame: Transform) -> Model:
    """The included model with the pose and settings of its include; what the include does not set stays.

    `frame` is the frame of the model relative to the frame that the include places.
    """
    placement = include.placement_frame or model.placement_frame
    # libsdformat refuses it: <pose> is required with <placement_frame>.
    if include.placement_frame is not None and include.pose is None:
        message = f"the include of {include.uri!r} has a placement_frame and no pose"
        sink.report(rules.PLACEMENT_WITHOUT_POSE, message, include.location, found=include.placement_frame)
    update = {
        "name": include.name if include.name is not None else model.name,
        "pose": _place_pose(include, frame) if include.pose is not None else model.pose,
        "static": include.static if include.static is not None else model.static,
        "placement_frame": placement,
        "plugins": (*model.plugins, *include.plugins),
        "opaque": _merge_parts(model, tuple(_model_parts(include, sink))),
        "source": include.source,
    }
    return model.copy(**update)


def frame_of_sdf(robot: Model) -> Transform:
    """The frame that a URDF robot had in the SDF that it was converted from, relative to its root link."""
    found = find_annotation(robot, OFFSET) if came_from(robot, Format.SDF) else None
    with suppress(ValueError):  # the conversion reports what is wrong with it
        return read_offset(found) if found else Transform()
    return Transform()


def _place_pose(include: Include, frame: Transform) -> Pose | None:
    """The pose of the frame of the model; for `placement_frame` the pose of that frame."""
    # libsdformat places the root link of an included URDF, whatever frame the model had in the SDF
    # that it was converted from. To read it otherwise would be another world than Gazebo's.
    if include.pose is None or include.placement_frame is not None or frame.is_identity:
        return include.pose
    return Transform.from_pose(include.pose).compose(frame).to_pose(include.pose.relative_to)


def place_light(include: Include, light: Light) -> Light:
    """The included light at the pose of the include."""
    update = {
        "name": include.name if include.name is not None else light.name,
        "pose": include.pose if include.pose is not None else light.pose,
        "source": include.source,
    }
    return light.copy(**update)


def place_actor(include: Include, document: Document) -> Opaque | None:
    """The actor of a document at the pose of the include; None where there is none."""
    part = next((part for part in document.opaque if part.element and part.element.name == "actor"), None)
    if part is None or part.element is None:
        return None
    actor = part.element
    if include.name is not None:
        others = tuple(pair for pair in actor.attributes if pair[0] != "name")
        actor = actor.copy(attributes=(("name", include.name), *others))
    if include.pose is not None:
        others = tuple(child for child in actor.children if child.name != "pose")
        actor = actor.copy(children=(to_element(include.pose, "pose", "sdf"), *others))
    plugins = tuple(to_element(plugin, "plugin", "sdf") for plugin in include.plugins)
    actor = actor.copy(children=(*actor.children, *plugins))
    return part.copy(element=actor, source=include.source)


def _model_parts(include: Include, sink: DiagnosticSink) -> Iterator[Opaque]:
    """Parts of an include that become parts of the model."""
    for part in include.opaque:
        name = part.element.name if part.element else ""
        if part.element is not None and name == "namespace" and part.element.text:
            yield Opaque.unchecked(attribute=("namespace", part.element.text), source=part.source)
        elif name == "model_state":
            yield part
        else:
            _report_leftover(include, part, sink)


def _merge_parts(model: Model, parts: tuple[Opaque, ...]) -> tuple[Opaque, ...]:
    """The parts of a model, and others, whose attributes take the place of those of the model."""
    given = {part.attribute[0] for part in parts if part.attribute}
    return (*(part for part in model.opaque if not (part.attribute and part.attribute[0] in given)), *parts)


def account_replaced_include(include: Include, sink: DiagnosticSink) -> None:
    """Account for the URI of an include, which the included model replaces."""
    message = f"the include of {include.uri!r} is replaced by the included model"
    sink.account(Fate.DROPPED, rules.INCLUDE_LEFTOVER, message, include.location.at("uri"))


def report_leftovers(include: Include, sink: DiagnosticSink) -> None:
    """Report untyped parts of an include, which have no effect."""
    for part in include.opaque:
        _report_leftover(include, part, sink)


def _report_leftover(include: Include, part: Opaque, sink: DiagnosticSink) -> None:
    where = include.location.at(_local_name(part.element)) if part.element else include.location
    if part.element is not None and _local_name(part.element) == _PARAMETERS:
        message = f"the parameters of the include of {include.uri!r} cannot be applied"
        sink.report(rules.INCLUDE_PARAMETERS, message, where, found=_PARAMETERS)
        return
    message = f"{part.name} of the include of {include.uri!r} is left out"
    sink.report(rules.INCLUDE_LEFTOVER, message, where)
    sink.account(Fate.DROPPED, rules.INCLUDE_LEFTOVER, message, where, part.weight)


def _local_name(element: Element) -> str:
    return element.name.rpartition("}")[2]
