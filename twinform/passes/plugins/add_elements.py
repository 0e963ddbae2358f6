"""Adding plugins, sensors and their frames to models and worlds, in URDF and SDF, and finding the place for them."""

import math
from collections.abc import Iterator

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import (
    Document,
    Element,
    Format,
    Frame,
    GazeboExtension,
    Joint,
    Link,
    Model,
    Opaque,
    Plugin,
    Pose,
    Sensor,
    World,
    replace_fields,
)
from twinform.ir.scopes import SCOPE, nested_models, outer_models, scoped_models
from twinform.ir.transform import Transform
from twinform.passes.plugins.catalog import release, suggestion
from twinform.passes.plugins.sites import plugin_element, sensor_element
from twinform.passes.shared.poses import in_radians

_FRAME_ELEMENTS = frozenset({"frame_id", "gz_frame_id", "ignition_frame_id"})
# Cameras with nothing but images. Those with clouds stamp both with one frame, and a cloud of
# Gazebo looks along x.
_IMAGES = frozenset({"camera", "thermal_camera", "segmentation_camera", "wideanglecamera"})
# The frame of an image in that of its camera: it looks along z, with x to the right (REP 103).
_OPTICAL = Transform.from_pose(Pose(rpy=(-math.pi / 2, 0.0, -math.pi / 2)))


def models_of(document: Document) -> Iterator[tuple[str, Model]]:
    """Every model with its name, scoped names for nested models."""
    for model in outer_models(document):
        for scope, each in scoped_models(model, model.name + SCOPE):
            yield scope.removesuffix(SCOPE), each


def find_model(document: Document, name: str | None, sink: DiagnosticSink) -> Model | None:
    """The model of this name, or the only one; None after a report if there is none, or if a name is needed."""
    models = list(models_of(document))
    # A nested model is never "the only one": it has to be named, since the model around it is meant
    # otherwise.
    outer = [model for called, model in models if SCOPE not in called]
    if name is None and len(outer) == 1:
        return outer[0]
    found = next((model for called, model in models if called == name), None)
    if found is None:
        report_missing_target(document, "model", name, [called for called, _ in models], sink)
    return found


def find_world(document: Document, name: str | None, sink: DiagnosticSink) -> World | None:
    """The world of this name, or the only one; None after a report if there is none, or if a name is needed."""
    if name is None and len(document.worlds) == 1:
        return document.worlds[0]
    found = next((world for world in document.worlds if world.name == name), None)
    if found is None:
        report_missing_target(document, "world", name, [world.name for world in document.worlds], sink)
    return found


def world_of(document: Document, model: Model) -> World | None:
    """The world that a model is in; None if it is in no world."""
    for world in document.worlds:
        if any(each is model for outer in world.models for each in nested_models(outer)):
            return world
    return None


def report_missing_target(
    document: Document | Model, what: str, name: str | None, known: list[str], sink: DiagnosticSink
) -> None:
    """Report that there is nothing of this name, or nothing unambiguous, to add to."""
    if name is None:
        message = f"there are several: {', '.join(known)}" if known else "there is none"
        sink.report(rules.NOTHING_TO_ADD_TO, f"it is not clear which {what} to add to: {message}", document.location)
        return
    help_ = suggestion(name, known, f"there are {', '.join(known)}" if known else None)
    message = f"there is no {what} {name!r} to add to"
    sink.report(rules.NOTHING_TO_ADD_TO, message, document.location, found=name, help=help_)


def add_plugin(model: Model, plugin: Plugin, format_: Format) -> Model:
    """The model with one more plugin after its others; the same model if it has an equal one."""
    if format_ is Format.SDF:
        return model if plugin in model.plugins else model.copy(plugins=(*model.plugins, plugin))
    return _add_extension(model, GazeboExtension(content=(plugin_element(plugin),)))


def add_visual_plugin(model: Model, on: str, plugin: Plugin, format_: Format) -> Model | None:
    """The model with a plugin on the visual `on`, or on all visuals of the link `on`; None if there is neither.

    In URDF all visuals of a link share what `<gazebo>` sets for them.
    """
    if format_ is Format.URDF:
        link = next((link for link in model.links if on == link.name or any(on == v.name for v in link.visuals)), None)
        if link is None:
            return None
        content = (Element(name="visual", children=(plugin_element(plugin),)),)
        return _add_extension(model, GazeboExtension(reference=link.name, content=content))
    made = replace_fields(model, links=tuple(_add_to_visuals(link, on, plugin) for link in model.links))
    return None if made is model else made


def _add_to_visuals(link: Link, on: str, plugin: Plugin) -> Link:
    if on != link.name and all(on != visual.name for visual in link.visuals):
        return link
    visuals = tuple(
        visual.copy(plugins=(*(each for each in visual.plugins if each != plugin), plugin))
        if on in {link.name, visual.name}
        else visual
        for visual in link.visuals
    )
    return link.copy(visuals=visuals)


def add_sensor(model: Model, holder: str, sensor: Sensor, format_: Format, *, kept: bool = False) -> Model:
    """The model with one more sensor on a link or joint; on the link if both have this name.

    `kept` protects a fixed joint of URDF from lumping, which would remove the joint with its sensor.
    """
    if format_ is Format.URDF:
        keep = (Element(name="preserveFixedJoint", text="true"),) if kept else ()
        return _add_extension(model, GazeboExtension(reference=holder, content=(*keep, sensor_element(sensor))))
    field = "links" if any(link.name == holder for link in model.links) else "joints"
    nodes = tuple(
        node.copy(sensors=(*node.sensors, sensor)) if node.name == holder else node for node in getattr(model, field)
    )
    return model.copy(**{field: nodes})


def add_world_plugin(world: World, plugin: Plugin) -> World:
    """The world with one more plugin; the same world if it has an equal one."""
    return world if plugin in world.plugins else world.copy(plugins=(*world.plugins, plugin))


def _add_extension(model: Model, extension: GazeboExtension) -> Model:
    """The model with one more `<gazebo>`; the same model if it has an equal one."""
    return model if extension in model.extensions else model.copy(extensions=(*model.extensions, extension))


def frames_of(sensor: Sensor) -> Iterator[str]:
    """The frames that a sensor names, in any spelling."""
    if sensor.frame_id:
        yield sensor.frame_id
    for part in sensor.opaque:
        if part.element is not None and part.element.name in _FRAME_ELEMENTS and not part.at:
            yield (part.element.text or "").strip()


def set_frame_id(sensor: Sensor, frame: str, gazebo: str) -> Sensor:
    """The sensor with the frame of its messages, in the spelling that a release reads."""
    # <optical_frame_id> of cameras is deprecated since SDF 1.12, so all kinds of sensors get the
    # same element, which has three spellings: ignition_frame_id, gz_frame_id, and frame_id.
    element = release(gazebo).frame_element
    if element is None or element == "frame_id":
        return sensor.copy(frame_id=frame if element else None)
    written = Opaque(element=Element(name=element, text=frame))
    return sensor.copy(opaque=(written, *sensor.opaque))


def own_frame_name(model: Model, sensor: Sensor, type_: str) -> str | None:
    """The name for a frame of the sensor's own; None if it makes no images and is at the origin of its link."""
    # ROS takes the data of a message for measured at the origin of the frame that it names. A
    # sensor that sits off its link's origin therefore needs a frame of its own.
    if type_ not in _IMAGES and not is_placed(sensor):
        return None
    name = f"{sensor.name}_optical_frame" if type_ in _IMAGES else f"{sensor.name}_frame"
    return _unused_name(name, model)


def is_placed(sensor: Sensor) -> bool:
    """Whether a sensor is not at the origin of its link, or is posed relative to something else."""
    return bool(sensor.pose and sensor.pose.relative_to) or not Transform.from_pose(sensor.pose).is_identity


def add_own_frame(model: Model, name: str, sensor: Sensor, type_: str, link: str, format_: Format) -> Model:
    """The model with a frame for a sensor on a link, if the name is free; in URDF the frame is a link."""
    if any(each.name == name for each in (*model.links, *model.frames)):
        return model
    written = Transform.from_pose(sensor.pose)
    at = written.compose(_OPTICAL) if type_ in _IMAGES else written
    if format_ is Format.SDF:
        pose = at.to_pose(sensor.pose.relative_to if sensor.pose else None)
        return model.copy(frames=(*model.frames, Frame(name=name, attached_to=link, pose=pose)))
    # URDF has no frames. A massless link on a fixed joint is read as a frame by Gazebo, and
    # robot_state_publisher publishes its transform.
    joint = _unused_name(f"{name}_joint", model)
    mount = Joint(name=joint, type="fixed", parent=link, child=name, pose=in_radians(at, link))
    held = Link(name=name, pose=Pose(relative_to=joint))
    return model.copy(links=(*model.links, held), joints=(*model.joints, mount))


def _unused_name(name: str, model: Model) -> str:
    """The name, with underscores appended while a joint has it."""
    while any(joint.name == name for joint in model.joints):
        name += "_"
    return name
