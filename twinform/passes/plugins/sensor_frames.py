"""Frames of sensors: what their messages name, and links at their places for the tree of transforms in ROS."""

import math
from collections.abc import Iterator

from twinform.ir import Element, Format, Frame, Joint, Link, Model, Opaque, Pose, Sensor
from twinform.ir.transform import Transform
from twinform.passes.plugins.catalog import release
from twinform.passes.transforms.pose_notation import in_radians

_ELEMENTS = frozenset({"frame_id", "gz_frame_id", "ignition_frame_id"})
# Cameras with nothing but images. Those with clouds stamp both with one frame, and a cloud of
# Gazebo looks along x.
_IMAGES = frozenset({"camera", "thermal_camera", "segmentation_camera", "wideanglecamera"})
# The frame of an image in that of its camera: it looks along z, with x to the right (REP 103).
_OPTICAL = Transform.from_pose(Pose(rpy=(-math.pi / 2, 0.0, -math.pi / 2)))


def frames_of(sensor: Sensor) -> Iterator[str]:
    """The frames that a sensor names, for whatever release."""
    if sensor.frame_id:
        yield sensor.frame_id
    for part in sensor.opaque:
        if part.element is not None and part.element.name in _ELEMENTS and not part.at:
            yield (part.element.text or "").strip()


def named_frame(sensor: Sensor, frame: str, gazebo: str) -> Sensor:
    """The sensor with the frame of its messages, as a release reads it."""
    # <optical_frame_id> of cameras is deprecated since SDF 1.12, so all kinds of sensors get the
    # same element, which has three spellings: ignition_frame_id, gz_frame_id, and frame_id.
    element = release(gazebo).frame_element
    if element is None or element == "frame_id":
        return sensor.copy(frame_id=frame if element else None)
    written = Opaque(element=Element(name=element, text=frame))
    return sensor.copy(opaque=(written, *sensor.opaque))


def own_frame(model: Model, sensor: Sensor, type_: str) -> str | None:
    """The name for a frame of its own, which a sensor needs that is not where its link is, or makes images."""
    # ROS takes the data of a message for measured at the origin of the frame that it names. A
    # sensor that sits off its link's origin therefore needs a frame of its own.
    if type_ not in _IMAGES and not is_placed(sensor):
        return None
    name = f"{sensor.name}_optical_frame" if type_ in _IMAGES else f"{sensor.name}_frame"
    return _unused(name, model)


def is_placed(sensor: Sensor) -> bool:
    """Whether a sensor is elsewhere than its link, or given relative to something else."""
    return bool(sensor.pose and sensor.pose.relative_to) or not Transform.from_pose(sensor.pose).is_identity


def with_own_frame(model: Model, name: str, sensor: Sensor, type_: str, link: str, format_: Format) -> Model:
    """The model with the frame of a sensor on a link, unless it has something of that name; in URDF it is a link."""
    if any(each.name == name for each in (*model.links, *model.frames)):
        return model
    written = Transform.from_pose(sensor.pose)
    at = written.compose(_OPTICAL) if type_ in _IMAGES else written
    if format_ is Format.SDF:
        pose = at.to_pose(sensor.pose.relative_to if sensor.pose else None)
        return model.copy(frames=(*model.frames, Frame(name=name, attached_to=link, pose=pose)))
    # URDF has no frames. A massless link on a fixed joint is read as a frame by Gazebo, and
    # robot_state_publisher publishes its transform.
    joint = _unused(f"{name}_joint", model)
    mount = Joint(name=joint, type="fixed", parent=link, child=name, pose=in_radians(at, link))
    held = Link(name=name, pose=Pose(relative_to=joint))
    return model.copy(links=(*model.links, held), joints=(*model.joints, mount))


def _unused(name: str, model: Model) -> str:
    """The name, or a longer one where a joint has it."""
    while any(joint.name == name for joint in model.joints):
        name += "_"
    return name
