"""Facts about masses, inertias and what moves joints: limits, mimics, transmissions; as engines read them."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from twinform.ir.solids import principal_moments
from twinform.profiles.forms import number_in
from twinform.profiles.nodes import Fact, FactTable, RawNode, add_fixed, fixed_children

# mjMINVAL, at or below which MuJoCo counts a mass (kg) or a moment (kg m2) as none.
_LIGHTEST = 1e-15
# In kg m2: MuJoCo counts smaller principal moments as none.
_SMALLEST = 1e-14
# Drake accepts a largest moment that exceeds the sum of the others by this part of it.
_SLACK = 1e-9
# What finding the axes of an inertia costs, relative to its largest moment.
_ROUNDING = 1e-14
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
ONE_AXIS = frozenset({"revolute", "continuous", "prismatic"})
"""The types of joints that turn about one axis or slide along it."""
_NUMBERS_READ = {
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


class RawBody(NamedTuple):
    """The mass and the moments of a link, and its principal moments; None where they are not finite numbers."""

    node: RawNode
    mass: float | None
    moments: tuple[float, ...]
    principal: tuple[float, ...] | None

    @property
    def is_empty(self) -> bool:
        """Whether all moments are 0."""
        return not any(self.moments)

    @property
    def excess(self) -> float | None:
        """How far the largest moment exceeds the sum of the others; None if it is not positive, and for the world."""
        if self.principal is None or self.principal[0] <= 0 or self.node.name == "world":
            return None
        low, middle, high = self.principal
        return high - (low + middle)

    @property
    def lost(self) -> float:
        """The rounding error of a moment whose axes have to be computed, in kg m2."""
        _, xy, xz, _, yz, _ = self.moments
        return _ROUNDING * self.principal[2] if self.principal is not None and (xy or xz or yz) else 0.0


def _raw_bodies(root: RawNode) -> Iterator[RawBody]:
    """The links with an inertial."""
    for link in root.all("link"):
        inertial = link.first("inertial")
        if inertial is None:
            continue
        inertia = inertial.first("inertia")
        texts = [inertia.attributes.get(name, "0") if inertia else "0" for name in _MOMENTS]
        found = [number_in(text) for text in texts]
        mass = number_in(inertial.value("mass", "value") or "0")
        moments = tuple(0.0 if number is None else number for number in found)
        yield RawBody(link, mass, moments, _principal_moments(moments))


def _principal_moments(moments: tuple[float, ...]) -> tuple[float, ...] | None:
    if not all(map(math.isfinite, moments)):
        return None
    xx, xy, xz, yy, yz, zz = moments
    return tuple(sorted(principal_moments((xx, yy, zz, xy, xz, yz))))


def _indefinite_inertias(root: RawNode) -> Fact:
    """Inertias with a moment that is not positive, unless all moments are 0."""
    for body in _raw_bodies(root):
        if not body.is_empty and body.principal is not None and body.principal[0] < _SMALLEST:
            yield body.node, f"link {body.node.name!r} has a moment that is not positive, or next to nothing"


def _unbalanced_inertias(root: RawNode) -> Fact:
    """Inertias whose largest moment is greater than the sum of the other two, except that of the world."""
    for body in _raw_bodies(root):
        if (excess := body.excess) is not None and excess > body.lost:
            yield body.node, f"link {body.node.name!r} has a moment above the sum of the other two"


def _uncertain_inertias(root: RawNode) -> Fact:
    """Inertias whose largest moment is the sum of the other two, up to rounding."""
    for body in _raw_bodies(root):
        if (excess := body.excess) is not None and -body.lost < excess <= body.lost:
            yield body.node, f"link {body.node.name!r} has a moment next to the sum of the other two"


def _unphysical_inertias(root: RawNode) -> Fact:
    """Inertias that no body has: a moment above the sum of the others, a negative one, or moments without a mass."""
    for body in _raw_bodies(root):
        principal, mass = body.principal, body.mass or 0.0
        wrong = principal is None or principal[0] < -_SLACK * abs(principal[2]) or _is_unbalanced(principal)
        if wrong or mass < 0 or (mass == 0 and not body.is_empty):
            yield body.node, f"the inertia of link {body.node.name!r} is physically impossible"


def _is_unbalanced(principal: tuple[float, ...]) -> bool:
    low, middle, high = principal
    return low + middle < high * (1 - _SLACK)


def _weightless_bodies(root: RawNode) -> Fact:
    """Links that move and have no mass or no inertia, even with all links that are fixed to them."""
    heavy = {body.node.name for body in _raw_bodies(root) if _weighs(body)}
    # Without <inertial>, MuJoCo computes the mass from the collision shapes.
    heavy |= {link.name for link in root.all("link") if not link.first("inertial") and link.first("collision")}
    fixed = fixed_children(root)
    links = {link.name: link for link in root.all("link")}
    for joint in root.all("joint"):
        child = joint.value("child", "link") or ""
        if joint.type != "fixed" and child in links and not heavy & add_fixed((child,), fixed):
            yield links[child], f"link {child!r} moves and has no mass or no inertia, nor has what is fixed to it"


def _weighs(body: RawBody) -> bool:
    mass = body.mass or 0.0
    return mass > _LIGHTEST and body.principal is not None and body.principal[2] > _LIGHTEST


def _read_limits(joint: RawNode) -> tuple[RawNode | None, float, float]:
    limit = joint.first("limit")
    lower = number_in(limit.attributes.get("lower", "")) if limit else None
    upper = number_in(limit.attributes.get("upper", "")) if limit else None
    return limit, -math.inf if lower is None else lower, math.inf if upper is None else upper


def _reversed_limits(root: RawNode) -> Fact:
    """Lower limits above the upper ones."""
    for joint in root.all("joint"):
        limit, lower, upper = _read_limits(joint)
        if limit is not None and joint.type in ONE_AXIS and lower > upper:
            yield limit, f"joint {joint.name!r} has the lower limit {lower:g} above the upper one, {upper:g}"


def _equal_limits(root: RawNode) -> Fact:
    """Limits that leave no room to move; a limit that is not written is 0."""
    for joint in root.all("joint"):
        limit = joint.first("limit")
        if limit is None or joint.type not in ONE_AXIS or not {"lower", "upper"} <= limit.attributes.keys():
            continue
        _, lower, upper = _read_limits(joint)
        if lower == upper != 0:
            yield limit, f"joint {joint.name!r} has equal limits"
        elif lower == upper and _is_written(limit):
            yield limit, f"joint {joint.name!r} has limits of 0"


def _is_written(limit: RawNode) -> bool:
    return all(limit.attributes[end].strip() for end in ("lower", "upper"))


def _self_mimics(root: RawNode) -> Fact:
    """Joints that mimic themselves."""
    for joint in root.all("joint"):
        if joint.value("mimic", "joint") == joint.name and joint.type in ONE_AXIS:
            yield joint, f"joint {joint.name!r} follows itself"


def _idle_mimics(root: RawNode) -> Fact:
    """Joints that mimic a joint that is missing, or that does not turn or slide."""
    moving = {joint.name for joint in root.all("joint") if joint.type in ONE_AXIS}
    for joint in root.all("joint"):
        leader = joint.value("mimic", "joint")
        if leader is not None and leader not in moving and joint.type in ONE_AXIS:
            yield joint, f"joint {joint.name!r} follows {leader!r}, which does not turn or slide"


def _unknown_numbers(root: RawNode) -> Fact:
    """NaN in numbers that MuJoCo reads."""
    waiting = [*root.all("link"), *root.all("joint")]
    while waiting:
        node = waiting.pop()
        waiting += [child for child in node.children if child.tag != "visual"]
        for name in _NUMBERS_READ.get(node.tag, ()):
            text = node.attributes.get(name, "")
            if any("nan" in piece.lower() and _is_nan(piece) for piece in text.split()):
                yield node, f"{name!r} of <{node.tag}> is {text!r}"


def _is_nan(piece: str) -> bool:
    number = number_in(piece)
    return number is not None and math.isnan(number)


def _foreign_transmissions(root: RawNode) -> Fact:
    """Transmissions without a type, and simple ones without a named actuator or an existing joint."""
    joints = {joint.name for joint in root.all("joint")}
    for node in root.all("transmission"):
        kind = _transmission_kind(node)
        if kind is None:
            yield node, "<transmission> has no type"
        elif "SimpleTransmission" in kind and (
            node.value("actuator", "name") is None or node.value("joint", "name") not in joints
        ):
            yield node, "<transmission> has no actuator with a name, or no joint that is there"


def _transmission_kind(node: RawNode) -> str | None:
    """The type of a transmission, an element or an attribute."""
    type_ = node.first("type")
    return node.type if type_ is None else type_.text


def _simple_transmissions(root: RawNode) -> Iterator[tuple[RawNode, RawNode | None]]:
    """The simple transmissions, each with its joint if that exists."""
    joints = {joint.name: joint for joint in root.all("joint")}
    for node in root.all("transmission"):
        if "SimpleTransmission" in (_transmission_kind(node) or ""):
            yield node, joints.get(node.value("joint", "name") or "")


def _joint_effort(joint: RawNode) -> float:
    """The effort limit of a joint; infinite where there is none."""
    text = joint.value("limit", "effort")
    number = None if text is None else number_in(text)
    return math.inf if number is None else number


def _repeated_actuators(root: RawNode) -> Fact:
    """Actuators of two transmissions, and negative efforts of joints that have an actuator."""
    met = set[str]()
    for node, joint in _simple_transmissions(root):
        if joint is None or joint.type not in ONE_AXIS or _joint_effort(joint) == 0:
            continue
        name = node.value("actuator", "name") or ""
        if name in met or _joint_effort(joint) < 0:
            yield node, f"actuator {name!r} is of two transmissions, or its joint has an effort below 0"
        met.add(name)


def _idle_transmissions(root: RawNode) -> Fact:
    """Transmissions that are not simple, or whose joint is fixed or has no effort."""
    for node in root.all("transmission"):
        if "SimpleTransmission" not in (_transmission_kind(node) or "SimpleTransmission"):
            yield node, "<transmission> is not a SimpleTransmission"
    for node, joint in _simple_transmissions(root):
        if joint is not None and (joint.type == "fixed" or _joint_effort(joint) == 0):
            yield node, f"<transmission> is of {joint.name!r}, which does not move or has no effort"


FACTS: FactTable = {
    "indefinite-inertia": _indefinite_inertias,
    "unbalanced-inertia": _unbalanced_inertias,
    "uncertain-inertia": _uncertain_inertias,
    "unphysical-inertia": _unphysical_inertias,
    "weightless-body": _weightless_bodies,
    "reversed-limits": _reversed_limits,
    "equal-limits": _equal_limits,
    "self-mimic": _self_mimics,
    "idle-mimic": _idle_mimics,
    "unknown-number": _unknown_numbers,
    "foreign-transmission": _foreign_transmissions,
    "repeated-actuator": _repeated_actuators,
    "idle-transmission": _idle_transmissions,
}
