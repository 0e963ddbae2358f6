"""Soft limits, and what is wrong with them, with damping and with friction: for `check` and the passes of limits."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from twinform.diagnostics import Location, Rule, rules
from twinform.ir import Axis, Element, Joint, Limit, Opaque
from twinform.passes.carriers.carriers import is_carrier, unpack

_ELEMENT = "safety_controller"
_BOUNDED = frozenset({"revolute", "prismatic"})


class LimitFinding(NamedTuple):
    """What is wrong with a limit, before it is reported; `may_be_meant` is whether it may be an idiom."""

    rule: Rule
    message: str
    where: Location
    found: str
    expected: str | None = None
    may_be_meant: bool = False


class SoftLimits(NamedTuple):
    """The positions where a controller begins to brake, in rad or m; None where none is written."""

    lower: float | None
    upper: float | None

    def __str__(self) -> str:
        """The range as messages have it."""
        lower, upper = ("open" if end is None else f"{end:g}" for end in self)
        return f"{lower} to {upper}"


def find_faults(joint: Joint) -> Iterator[LimitFinding]:
    """Find damping and friction below zero, and soft limits that are not inside of the hard ones."""
    for axis in (joint.axis, joint.axis2):
        if axis is not None:
            yield from check_dynamics(joint, axis)
    yield from check_soft_limits(joint)


def check_dynamics(joint: Joint, axis: Axis) -> Iterator[LimitFinding]:
    """Find damping and friction below zero."""
    if axis.dynamics is None:
        return
    for name in ("damping", "friction"):
        value = getattr(axis.dynamics, name)
        if value is not None and value < 0:
            message = f"the {name} of joint {joint.name!r} is {value:g}"
            yield LimitFinding(rules.NEGATIVE_DYNAMICS, message, axis.dynamics.location, f"{value:g}", "0 or more")


def check_soft_limits(joint: Joint) -> Iterator[LimitFinding]:
    """Find soft limits that are not inside of the hard ones."""
    soft, limit = soft_limits(joint), joint.axis.limit if joint.axis else None
    if soft is None:
        return
    written, where = str(soft), joint.location.at("safety_controller")
    if _is_less(soft.upper, soft.lower):
        message = f"the lower soft limit of joint {joint.name!r} is above the upper one: {written}"
        yield LimitFinding(rules.SOFT_LIMIT_OUTSIDE, message, where, written)
        return
    hard = limit if joint.type in _BOUNDED else None
    if hard and (_is_less(soft.lower, hard.lower) or _is_less(hard.upper, soft.upper)):
        message = f"the soft limits of joint {joint.name!r}, {written}, are outside of the hard ones"
        # Beyond both of the hard ones, a soft limit is switched off, as in the robots of the DRC.
        is_off = _is_less(soft.lower, hard.lower) and _is_less(hard.upper, soft.upper)
        yield LimitFinding(rules.SOFT_LIMIT_OUTSIDE, message, where, written, may_be_meant=is_off)


def _is_less(one: float | None, other: float | None) -> bool:
    return one is not None and other is not None and one < other


def soft_limits(joint: Joint) -> SoftLimits | None:
    """The soft limits of a joint: `<safety_controller>` in URDF, a carrier in SDF; two zeros mean none."""
    for element in _safety_controllers(joint):
        lower, upper = (_parse_number(element.get(name)) for name in ("soft_lower_limit", "soft_upper_limit"))
        if lower or upper:
            return SoftLimits(lower, upper)
    return None


def _safety_controllers(joint: Joint) -> Iterator[Element]:
    """Every safety controller of a joint, also in carriers."""
    parts: list[Opaque] = []
    for part in joint.opaque:
        parts += unpack(part) if is_carrier(part, "urdf") else (part,)
    for part in parts:
        if part.element and part.element.name == _ELEMENT:
            yield part.element


def _parse_number(text: str | None) -> float | None:
    """The number of an attribute; None for other texts, which are skipped as by other readers."""
    try:
        value = float(text) if text is not None else None
    except ValueError:
        return None
    return value if value is not None and math.isfinite(value) else None


def limit_location(joint: Joint, limit: Limit) -> Location:
    """The location of a limit; of its joint where the limit is not written."""
    return limit.location if limit.source else joint.location
