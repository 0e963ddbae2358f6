"""Facts about what moves joints: limits, joints that follow others, and transmissions."""

import math
from collections.abc import Iterator

from twinform.profiles.reading.forms import number_in
from twinform.profiles.reading.nodes import RawNode

Fact = Iterator[tuple[RawNode, str]]
_ONE_WAY = frozenset({"revolute", "continuous", "prismatic"})
_READ = {
    "mass": ("value",),
    "inertia": ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"),
    "origin": ("xyz", "rpy"),
    "axis": ("xyz",),
    "limit": ("lower", "upper", "effort"),
    "dynamics": ("damping", "friction"),
    "mimic": ("multiplier", "offset"),
    "color": ("rgba",),
    "box": ("size",),
    "cylinder": ("radius", "length"),
    "sphere": ("radius",),
    "capsule": ("radius", "length"),
}
"""The numbers that MuJoCo reads."""


def _name(node: RawNode) -> str:
    return node.attributes.get("name", "")


def _limits(joint: RawNode) -> tuple[RawNode | None, float, float]:
    limit = joint.first("limit")
    lower = number_in(limit.attributes.get("lower", "")) if limit else None
    upper = number_in(limit.attributes.get("upper", "")) if limit else None
    return limit, -math.inf if lower is None else lower, math.inf if upper is None else upper


def reversed_limits(root: RawNode) -> Fact:
    """Lower limits above the upper ones."""
    for joint in root.all("joint"):
        limit, lower, upper = _limits(joint)
        if limit is not None and joint.attributes.get("type") in _ONE_WAY and lower > upper:
            yield limit, f"joint {_name(joint)!r} has the lower limit {lower:g} above the upper one, {upper:g}"


def equal_limits(root: RawNode) -> Fact:
    """Limits that leave no room; one that is not written is 0."""
    for joint in root.all("joint"):
        limit = joint.first("limit")
        if (
            limit is None
            or joint.attributes.get("type") not in _ONE_WAY
            or not {"lower", "upper"} <= limit.attributes.keys()
        ):
            continue
        _, lower, upper = _limits(joint)
        if lower == upper != 0:
            yield limit, f"joint {_name(joint)!r} has equal limits"
        elif lower == upper and _is_written(limit):
            yield limit, f"joint {_name(joint)!r} has limits of 0"


def _is_written(limit: RawNode) -> bool:
    return all(limit.attributes[end].strip() for end in ("lower", "upper"))


def self_mimics(root: RawNode) -> Fact:
    """Joints that follow themselves."""
    for joint in root.all("joint"):
        if joint.value("mimic", "joint") == _name(joint) and joint.attributes.get("type") in _ONE_WAY:
            yield joint, f"joint {_name(joint)!r} follows itself"


def idle_mimics(root: RawNode) -> Fact:
    """Joints that follow one that is not there, or that does not turn or slide."""
    moving = {_name(joint) for joint in root.all("joint") if joint.attributes.get("type") in _ONE_WAY}
    for joint in root.all("joint"):
        leader = joint.value("mimic", "joint")
        if leader is not None and leader not in moving and joint.attributes.get("type") in _ONE_WAY:
            yield joint, f"joint {_name(joint)!r} follows {leader!r}, which does not turn or slide"


def unknown_numbers(root: RawNode) -> Fact:
    """NaN, in what an engine reads."""
    waiting = [*root.all("link"), *root.all("joint")]
    while waiting:
        node = waiting.pop()
        waiting += [child for child in node.children if child.tag != "visual"]
        for name in _READ.get(node.tag, ()):
            text = node.attributes.get(name, "")
            if any("nan" in piece.lower() and _is_nan(piece) for piece in text.split()):
                yield node, f"{name!r} of <{node.tag}> is {text!r}"


def _is_nan(piece: str) -> bool:
    number = number_in(piece)
    return number is not None and math.isnan(number)


def foreign_transmissions(root: RawNode) -> Fact:
    """Simple transmissions without an actuator or a joint with a name that is there, and those without a type."""
    joints = {_name(joint) for joint in root.all("joint")}
    for node in root.all("transmission"):
        kind = _kind(node)
        if kind is None:
            yield node, "<transmission> has no type"
        elif "SimpleTransmission" in kind and (
            node.value("actuator", "name") is None or node.value("joint", "name") not in joints
        ):
            yield node, "<transmission> has no actuator with a name, or no joint that is there"


def _kind(node: RawNode) -> str | None:
    type_ = node.first("type")
    return node.attributes.get("type") if type_ is None else type_.text


def _driven(root: RawNode) -> Iterator[tuple[RawNode, RawNode | None]]:
    joints = {_name(joint): joint for joint in root.all("joint")}
    for node in root.all("transmission"):
        if "SimpleTransmission" in (_kind(node) or ""):
            yield node, joints.get(node.value("joint", "name") or "")


def _effort(joint: RawNode) -> float:
    text = joint.value("limit", "effort")
    number = None if text is None else number_in(text)
    return math.inf if number is None else number


def repeated_actuators(root: RawNode) -> Fact:
    """Actuators of two transmissions, and efforts below 0 of joints that have one."""
    met = set[str]()
    for node, joint in _driven(root):
        if joint is None or joint.attributes.get("type") not in _ONE_WAY or _effort(joint) == 0:
            continue
        name = node.value("actuator", "name") or ""
        if name in met or _effort(joint) < 0:
            yield node, f"actuator {name!r} is of two transmissions, or its joint has an effort below 0"
        met.add(name)


def idle_transmissions(root: RawNode) -> Fact:
    """Transmissions of another kind, of a fixed joint, or of one without an effort."""
    for node in root.all("transmission"):
        if "SimpleTransmission" not in (_kind(node) or "SimpleTransmission"):
            yield node, "<transmission> is not a SimpleTransmission"
    for node, joint in _driven(root):
        if joint is not None and (joint.attributes.get("type") == "fixed" or _effort(joint) == 0):
            yield node, f"<transmission> is of {_name(joint)!r}, which does not move or has no effort"
