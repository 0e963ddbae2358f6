"""Reversing joints: parent and child exchanged, the same positions for the same motion.

A joint moves its child by T(q) = X A(q) in the parent, where X is the joint's frame there and A the motion along its
axis. Seen from the child, the parent is at A(q)^-1 X^-1, and for one axis, and for a screw, A(q)^-1 is the motion along
the opposite axis. So the axis is turned around, and position, limits, damping, springs and mimics stay as they are.
"""

from typing import Any

from twinform.ir import Axis, Element, GazeboExtension, Joint, Opaque, Sensor
from twinform.ir.defaults import FORCE_TORQUE
from twinform.ir.node import Vector3

REVERSIBLE = frozenset({"fixed", "revolute", "continuous", "prismatic", "screw", "ball", "spherical", "floating"})
TURNING = frozenset({"revolute", "continuous", "screw"})
ABOUT_A_POINT = frozenset({"ball", "spherical"})
_WITHOUT_AXIS = frozenset({"fixed", "floating", *ABOUT_A_POINT})
_SWAPPED = {
    "child": "parent", "parent": "child", "child_to_parent": "parent_to_child", "parent_to_child": "child_to_parent",
}  # fmt: skip


def with_axis(joint: Joint, direction: Vector3) -> Axis | None:
    """The axis of a joint in another direction; a joint without a direction keeps what it has."""
    if joint.type in _WITHOUT_AXIS:
        return joint.axis
    # Turning the axis around instead of the positions leaves limits, mimics, calibration and
    # controllers as they are.
    return (joint.axis or Axis()).copy(xyz=direction)


def opposite(direction: Vector3) -> Vector3:
    """The other way."""
    x, y, z = direction
    return (-x + 0.0, -y + 0.0, -z + 0.0)


def measures_in_sensor(joint: Joint) -> bool:
    """Whether a sensor of the joint measures in axes of its own, which move with the child and not with the parent."""
    parts = [part.element for sensor in joint.sensors for part in sensor.opaque if part.element]
    return joint.type != "fixed" and any(_frame(part) == "sensor" for part in parts)


def block_measures_in_sensor(content: tuple[Element, ...]) -> bool:
    """Whether a `<gazebo>` element has a force-torque sensor that measures in its own axes."""
    torques = [part for element in content for part in element.walk()]
    return any(_frame(part) == "sensor" for part in torques)


def _frame(element: Element) -> str | None:
    frame = element.find("frame") if element.name == "force_torque" else None
    return (frame.text or "").strip() if frame is not None else None


def swapped_sensors(joint: Joint) -> tuple[Sensor, ...]:
    """The sensors of a joint, of which those of force and torque count the other way round."""
    return tuple(_sensor(sensor) for sensor in joint.sensors)


def _sensor(sensor: Sensor) -> Sensor:
    if sensor.type != "force_torque":
        return sensor
    parts = [part for part in sensor.opaque if not _is_torque(part)]
    torque = next((part.element for part in sensor.opaque if _is_torque(part) and part.element), None)
    made = Opaque(element=_torque(torque or Element(name="force_torque")))
    return sensor.copy(opaque=(*parts, made))


def _is_torque(part: Opaque) -> bool:
    return part.element is not None and part.element.name == "force_torque" and not part.at


def swapped_block(extension: GazeboExtension) -> GazeboExtension:
    """A `<gazebo>` element about a joint that was reversed."""
    content = tuple(_block(element) for element in extension.content)
    return extension.copy(content=content) if content != extension.content else extension


def _block(element: Element) -> Element:
    if element.name != "sensor" or element.get("type") != "force_torque":
        return element
    torque = element.find("force_torque")
    made = _torque(torque or Element(name="force_torque"))
    others = tuple(child for child in element.children if child is not torque)
    return element.copy(children=(*others, made))


def _torque(element: Element) -> Element:
    """`<force_torque>` with parent and child exchanged; what is not written is `child` and `child_to_parent`."""
    values = {child.name: (child.text or "").strip() for child in element.children}
    words: dict[str, Any] = {
        "frame": values.get("frame") or FORCE_TORQUE["frame"],
        "measure_direction": values.get("measure_direction") or FORCE_TORQUE["measure_direction"],
    }
    others = tuple(child for child in element.children if child.name not in words)
    made = tuple(Element(name=name, text=_SWAPPED.get(word, word)) for name, word in words.items())
    return element.copy(children=(*made, *others))
