"""Reversing joints: parent and child exchanged, the same positions for the same motion.

A joint moves its child by T(q) = X A(q) in the parent, where X is the frame of the joint there and A the motion along
its axis. Seen from the child, the parent is at A(q)^-1 X^-1, and for one axis, and for a screw, A(q)^-1 is the motion
along the opposite axis. So the axis is turned around, and position, limits, damping, springs and mimics stay as they
are.
"""

from typing import Any

from twinform.ir import Axis, Element, Format, Frame, GazeboExtension, Joint, Model, Opaque, Pose, Sensor
from twinform.ir.defaults import FORCE_TORQUE, direction
from twinform.ir.node import Vector3

REVERSIBLE = frozenset({"fixed", "revolute", "continuous", "prismatic", "screw", "ball", "spherical", "floating"})
TURNING = frozenset({"revolute", "continuous", "screw"})
ABOUT_A_POINT = frozenset({"ball", "spherical"})
_WITHOUT_AXIS = frozenset({"fixed", "floating", *ABOUT_A_POINT})
_SWAPPED = {
    "child": "parent", "parent": "child", "child_to_parent": "parent_to_child", "parent_to_child": "child_to_parent",
}  # fmt: skip


def reroot_sdf(model: Model, way: list[Joint]) -> Model:
    """The model with another root; `way` has the joints from the new root up to the old one.

    The canonical link stays: the frame of the model, and all that is attached to it, moves with the same body as
    before.
    """
    made = {joint.name: _reverse_joint(joint) for joint in way}
    children = {joint.name: joint.child or "" for joint in way}
    joints = tuple(made.get(joint.name, joint) for joint in model.joints)
    frames = tuple(_reattach_frame(frame, children) for frame in model.frames)
    return model.copy(joints=joints, frames=frames)


def _reverse_joint(joint: Joint) -> Joint:
    """The joint with parent and child exchanged; its frame stays in place, and moves with the new child."""
    pose = joint.pose or Pose.unchecked()
    base = pose.relative_to or joint.child
    pose = pose.copy(relative_to=None if base == joint.parent else base)
    update = {
        "parent": joint.child,
        "child": joint.parent,
        "pose": None if pose == Pose.unchecked() else pose,
        "axis": turn_axis(joint, opposite(direction(joint.axis, Format.SDF))),
        "sensors": swap_sensors(joint),
    }
    return joint.copy(**update)


def _reattach_frame(frame: Frame, children: dict[str, str]) -> Frame:
    """The frame, attached to the link that it moved with if it was attached to a reversed joint."""
    joint = frame.attached_to or ""
    if joint not in children:
        return frame
    pose = frame.pose or Pose.unchecked()
    if not pose.relative_to:
        pose = pose.copy(relative_to=joint)
    return frame.copy(attached_to=children[joint], pose=pose)


def turn_axis(joint: Joint, direction: Vector3) -> Axis | None:
    """The axis of a joint in another direction; joints without a direction keep their axis."""
    if joint.type in _WITHOUT_AXIS:
        return joint.axis
    # Turning the axis around instead of the positions leaves limits, mimics, calibration and
    # controllers as they are.
    return (joint.axis or Axis.unchecked()).copy(xyz=direction)


def opposite(direction: Vector3) -> Vector3:
    """The opposite direction."""
    x, y, z = direction
    return (-x + 0.0, -y + 0.0, -z + 0.0)


def measures_in_sensor(joint: Joint) -> bool:
    """Whether a sensor of the joint measures in its own frame, which moves with the child and not with the parent."""
    parts = [part.element for sensor in joint.sensors for part in sensor.opaque if part.element]
    return joint.type != "fixed" and any(_torque_frame(part) == "sensor" for part in parts)


def block_measures_in_sensor(content: tuple[Element, ...]) -> bool:
    """Whether a `<gazebo>` element has a force-torque sensor that measures in its own frame."""
    torques = [part for element in content for part in element.walk()]
    return any(_torque_frame(part) == "sensor" for part in torques)


def _torque_frame(element: Element) -> str | None:
    frame = element.find("frame") if element.name == "force_torque" else None
    return (frame.text or "").strip() if frame is not None else None


def swap_sensors(joint: Joint) -> tuple[Sensor, ...]:
    """The sensors of a joint, with force and torque in the opposite direction."""
    return tuple(_swap_sensor(sensor) for sensor in joint.sensors)


def _swap_sensor(sensor: Sensor) -> Sensor:
    if sensor.type != "force_torque":
        return sensor
    parts = [part for part in sensor.opaque if not _is_torque(part)]
    torque = next((part.element for part in sensor.opaque if _is_torque(part) and part.element), None)
    made = Opaque.unchecked(element=_swap_torque(torque or Element.unchecked(name="force_torque")))
    return sensor.copy(opaque=(*parts, made))


def _is_torque(part: Opaque) -> bool:
    return part.element is not None and part.element.name == "force_torque" and not part.at


def swap_block(extension: GazeboExtension) -> GazeboExtension:
    """The `<gazebo>` element of a reversed joint, with force and torque in the opposite direction."""
    content = tuple(_swap_in_sensor(element) for element in extension.content)
    return extension.copy(content=content) if content != extension.content else extension


def _swap_in_sensor(element: Element) -> Element:
    if element.name != "sensor" or element.get("type") != "force_torque":
        return element
    torque = element.find("force_torque")
    made = _swap_torque(torque or Element.unchecked(name="force_torque"))
    others = tuple(child for child in element.children if child is not torque)
    return element.copy(children=(*others, made))


def _swap_torque(element: Element) -> Element:
    """`<force_torque>` with parent and child exchanged; the defaults are `child` and `child_to_parent`."""
    values = {child.name: (child.text or "").strip() for child in element.children}
    words: dict[str, Any] = {
        "frame": values.get("frame") or FORCE_TORQUE["frame"],
        "measure_direction": values.get("measure_direction") or FORCE_TORQUE["measure_direction"],
    }
    others = tuple(child for child in element.children if child.name not in words)
    made = tuple(Element.unchecked(name=name, text=_SWAPPED.get(word, word)) for name, word in words.items())
    return element.copy(children=(*made, *others))
