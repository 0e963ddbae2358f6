"""Check that joint limits are plausible for a robot."""

import math
from collections.abc import Iterator
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, rules
from twinform.diagnostics.rules import UNBOUNDED_LIMIT
from twinform.ir import Document, Format, Joint, Limit, rewrite
from twinform.ir.defaults import UNLIMITED, with_range
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name
from twinform.passes.joints.limit_faults import LimitFinding, check_dynamics, check_soft_limits, limit_location

_BOUNDED = frozenset({"revolute", "prismatic"})
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
