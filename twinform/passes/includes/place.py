"""What an `<include>` changes in the included model: name, pose, plugins."""

from collections.abc import Iterator
from contextlib import suppress

from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import Document, Element, Format, Include, Light, Model, Opaque, Pose
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.carriers.carriers import to_element
from twinform.passes.carriers.provenance import came_from
from twinform.passes.transforms.pose_notation import OFFSET, read_offset

_PARAMETERS = "params"
"""The local name of `<experimental:params>`."""


def placed_model(include: Include, model: Model, sink: DiagnosticSink, frame: Transform) -> Model:
    """The included model with the pose and settings of its include; what this does not set stays.

    `frame` is the frame of the model in the one that the include places.
    """
    placement = include.placement_frame or model.placement_frame
    # libsdformat refuses it: <pose> is required with <placement_frame>.
    if include.placement_frame is not None and include.pose is None:
        message = f"the include of {include.uri!r} has a placement_frame and no pose"
        sink.report(rules.PLACEMENT_WITHOUT_POSE, message, include.location, found=include.placement_frame)
    update = {
        "name": include.name if include.name is not None else model.name,
        "pose": _pose(include, frame) if include.pose is not None else model.pose,
        "static": include.static if include.static is not None else model.static,
        "placement_frame": placement,
        "plugins": (*model.plugins, *include.plugins),
        "opaque": (*model.opaque, *_additions(include, model, sink)),
        "source": include.source,
    }
    return model.copy(**update)


def frame_of_sdf(robot: Model) -> Transform:
    """The frame that a robot of URDF had in the SDF that it was converted from, in that of its root link."""
    found = find_annotation(robot, OFFSET) if came_from(robot, Format.SDF) else None
    with suppress(ValueError):  # the conversion reports what is wrong with it
        return read_offset(found) if found else Transform()
    return Transform()


def _pose(include: Include, frame: Transform) -> Pose | None:
    """Where the model's frame is; a frame that the include places by name is at that place."""
    # libsdformat places the root link of an included URDF, whatever frame the model had in the SDF
    # that it was converted from. To read it otherwise would be another world than Gazebo's.
    if include.pose is None or include.placement_frame is not None or frame.is_identity:
        return include.pose
    return Transform.from_pose(include.pose).compose(frame).to_pose(include.pose.relative_to)


def placed_light(include: Include, light: Light) -> Light:
    """The included light at the pose of the include."""
    update = {
        "name": include.name if include.name is not None else light.name,
        "pose": include.pose if include.pose is not None else light.pose,
        "source": include.source,
    }
    return light.copy(**update)


def placed_actor(include: Include, document: Document) -> Opaque | None:
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


def _additions(include: Include, model: Model, sink: DiagnosticSink) -> Iterator[Opaque]:
    """Parts of an include that are parts of a model too."""
    for part in include.opaque:
        name = part.element.name if part.element else ""
        if part.element is not None and name == "namespace" and not _has_namespace(model):
            yield Opaque(attribute=("namespace", part.element.text or ""), source=part.source)
        elif name == "model_state":
            yield part
        else:
            _report_leftover(include, part, sink)


def _has_namespace(model: Model) -> bool:
    return any(part.attribute and part.attribute[0] == "namespace" for part in model.opaque)


def account_replaced(include: Include, sink: DiagnosticSink) -> None:
    """Say that the URI of an include went: what it names stands there now."""
    message = f"the include of {include.uri!r} is replaced by the included model"
    sink.account(Fate.DROPPED, rules.INCLUDE_LEFTOVER, message, include.location.at("uri"))


def report_leftovers(include: Include, sink: DiagnosticSink) -> None:
    """Say of all untyped parts of an include that they come to nothing."""
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
