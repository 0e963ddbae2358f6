"""Check that joint limits are plausible for a robot: also soft limits, damping and friction, for `check` and passes."""

import math
from collections.abc import Iterator
from typing import ClassVar, NamedTuple

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, Location, Rule, rules
from twinform.diagnostics.rules import UNBOUNDED_LIMIT
from twinform.ir import Axis, Document, Element, Format, Joint, Limit, Opaque, rewrite
from twinform.ir.defaults import UNLIMITED, with_range
from twinform.passes.carriers.carriers import is_carrier, unpack
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name

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
        return range_words(self.lower, self.upper)


def range_words(lower: float | None, upper: float | None) -> str:
    """Return a range as messages have it, of which one end or both may be missing."""
    if lower is None:
        return "unlimited" if upper is None else f"at most {upper:g}"
    return f"at least {lower:g}" if upper is None else f"{lower:g} to {upper:g}"


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


_TURNING = frozenset({"revolute", "universal", "revolute2"})
_DRIVEN = _BOUNDED | {"continuous"}


class CheckLimits(Pass):
    """Find limits, damping and friction of joints that a robot is not likely to have.

    Changes nothing.
    Diagnostics, for joints whose name matches `joints`:

    1. `empty-range`: lower and upper limits that are equal;
    2. `range-in-degrees`: a turning joint that may turn more than `turns` times;
    3. `zero-out-of-range`: limits that the zero position is not between;
    4. `unbounded-limit`: no limit of effort or velocity, or an infinite one;
    5. `implausible-limit`: more than `effort` or `velocity`;
    6. `soft-limit-outside`: soft limits that are not inside of the hard ones;
    7. `negative-dynamics`: damping or friction below zero.

    What `check` finds already it leaves alone: limits that are missing or upside down, and those of zero.
    Never looks at: joints without an axis, and models that an `<include>` names.
    """

    name = "check-limits"
    example: ClassVar[str] = "check-limits{effort=500 velocity=20}"

    turns: float = Field(default=2.0, gt=0, description="The most turns either way; `inf` for any.")
    effort: float = Field(default=1e5, gt=0, description="The greatest plausible effort, in N m or N; `inf` for any.")
    velocity: float = Field(default=1e3, gt=0, description="The greatest plausible speed, in rad/s or m/s.")
    joints: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only joints"))

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The same document."""

        def look(joint: Joint) -> Joint:
            if matches(joint.name, self.joints):
                for each in self._findings(joint, document.format):
                    if each.rule is rules.RANGE_IN_DEGREES and sink.has(each.rule, each.where):
                        continue  # verifying has seen what cannot be but degrees
                    sink.report(each.rule, each.message, each.where, found=each.found, expected=each.expected)
            return joint

        return rewrite(document, Joint, look)

    def _findings(self, joint: Joint, format_: Format) -> Iterator[LimitFinding]:
        for axis in (joint.axis, joint.axis2):
            if axis is None:
                continue
            if joint.type in _BOUNDED | _TURNING:
                yield from self._range(joint, axis.limit or Limit(), format_)
            if joint.type in _DRIVEN:
                yield from self._drive(joint, axis.limit or Limit())
            yield from check_dynamics(joint, axis)
        yield from check_soft_limits(joint)

    def _range(self, joint: Joint, limit: Limit, format_: Format) -> Iterator[LimitFinding]:
        written = with_range(limit, format_) if format_ is Format.URDF and limit.source else limit
        lower, upper = written.lower, written.upper
        if lower is None or upper is None or not lower <= upper:
            return
        where, found = limit_location(joint, limit), f"{lower:g} to {upper:g}"
        named = f"the limits of joint {joint.name!r} are {lower:g} and {upper:g}"
        if lower == upper:
            message = f"joint {joint.name!r} cannot move: both of its limits are {lower:g}"
            yield LimitFinding(rules.EMPTY_RANGE, message, where, found)
        most = self.turns * math.tau
        if joint.type in _TURNING and most < max(-lower, upper) < UNLIMITED:
            message = f"joint {joint.name!r} turns from {lower:g} to {upper:g} rad; are these degrees?"
            yield LimitFinding(rules.RANGE_IN_DEGREES, message, where, found, f"at most {most:.4g}")
        if not lower <= 0 <= upper:
            yield LimitFinding(rules.ZERO_OUT_OF_RANGE, f"{named}, and exclude its zero position", where, found)

    def _drive(self, joint: Joint, limit: Limit) -> Iterator[LimitFinding]:
        where = limit_location(joint, limit)
        open_ends = [name for name in ("effort", "velocity") if _is_unlimited(getattr(limit, name))]
        if open_ends:
            message = f"joint {joint.name!r} has no limit of {' and '.join(open_ends)}"
            yield LimitFinding(UNBOUNDED_LIMIT, message, where, "none")
        for name, most in (("effort", self.effort), ("velocity", self.velocity)):
            value = getattr(limit, name)
            if not _is_unlimited(value) and value > most:
                message = f"joint {joint.name!r} has a limit of {name} of {value:g}, which is more than actuators reach"
                yield LimitFinding(rules.IMPLAUSIBLE_LIMIT, message, where, f"{value:g}", f"at most {most:g}")


def _is_unlimited(value: float | None) -> bool:
    """Whether a limit is none: not written, negative (in SDF), or a value that stands for infinity."""
    return value is None or value < 0 or value >= UNLIMITED
