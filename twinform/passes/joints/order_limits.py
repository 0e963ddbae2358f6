"""Put limits that are the wrong way round in order, and take out negative damping and friction."""

import math
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import ORDERED_LIMITS
from twinform.ir import Axis, Document, Dynamics, Joint, Limit, rewrite
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name

_BOUNDED = frozenset({"revolute", "prismatic", "screw", "universal", "revolute2", "gearbox", "continuous"})


class OrderLimits(Pass):
    """Put limits in order, and make damping and friction what they can be, for engines that end otherwise.

    Changes joints whose name matches `joints`, along each of their axes:

    1. a lower limit above the upper one, where both are written, is swapped with it, as libsdformat does for URDF;
    2. a limit that is NaN is left out;
    3. a negative damping or friction becomes zero.

    Never touches: limits that are in order or not written, effort, velocity and springs.
    Diagnostics: `ordered-limits` for each.
    """

    name = "order-limits"
    example: ClassVar[str] = 'order-limits{joints="arm_*"}'

    joints: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only joints"))

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with limits in order."""

        def order(joint: Joint) -> Joint:
            if joint.type not in _BOUNDED or not matches(joint.name, self.joints):
                return joint
            axis, second = (_order_axis(joint, each, sink) for each in (joint.axis, joint.axis2))
            return joint.copy(axis=axis, axis2=second)

        return rewrite(document, Joint, order)


def _order_axis(joint: Joint, axis: Axis | None, sink: DiagnosticSink) -> Axis | None:
    if axis is None:
        return None
    limit, dynamics = _order_limit(joint, axis.limit, sink), _remove_negative(joint, axis.dynamics, sink)
    if limit is axis.limit and dynamics is axis.dynamics:
        return axis
    return axis.copy(limit=limit, dynamics=dynamics)


def is_usable(axis: Axis) -> bool:
    """Whether the limits of an axis are ordered numbers, and damping and friction are not negative."""
    limit, dynamics = axis.limit or Limit(), axis.dynamics or Dynamics()
    numbers = [number for number in (limit.lower, limit.upper) if number is not None]
    in_order = len(numbers) < 2 or not numbers[0] > numbers[1]
    return in_order and not any(map(math.isnan, numbers)) and not _negative_names(dynamics)


def _negative_names(dynamics: Dynamics) -> list[str]:
    values = {"damping": dynamics.damping, "friction": dynamics.friction}
    return [name for name, value in values.items() if value is not None and value < 0]


def _order_limit(joint: Joint, limit: Limit | None, sink: DiagnosticSink) -> Limit | None:
    if limit is None:
        return None
    lower, upper = (None if each is None or math.isnan(each) else each for each in (limit.lower, limit.upper))
    if (lower, upper) != (limit.lower, limit.upper):
        message = f"a limit of joint {joint.name!r} was no number, and is left out"
        sink.report(ORDERED_LIMITS, message, limit.location)
        limit = limit.copy(lower=lower, upper=upper)
    if lower is None or upper is None or lower <= upper:
        return limit
    was, now = f"{lower:g} to {upper:g}", f"{upper:g} to {lower:g}"
    message = f"the limits of joint {joint.name!r} were {was} and are {now}"
    sink.report(ORDERED_LIMITS, message, limit.location, found=was, expected=now)
    # libsdformat does the same where it reads URDF, with a warning; DART aborts on such limits.
    return limit.copy(lower=upper, upper=lower)


def _remove_negative(joint: Joint, dynamics: Dynamics | None, sink: DiagnosticSink) -> Dynamics | None:
    if dynamics is None or not (names := _negative_names(dynamics)):
        return dynamics
    for name in names:
        message = f"the {name} of joint {joint.name!r} was below zero and is 0"
        sink.report(ORDERED_LIMITS, message, dynamics.location, expected="0")
    # Negative damping drives a joint, and DART aborts on it; there is no other value that it could
    # stand for.
    return dynamics.copy(**dict.fromkeys(names, 0.0))
