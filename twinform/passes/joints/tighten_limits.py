"""Move the limits of joints inward."""

import math
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import TIGHTENED_LIMIT, UNTIGHTENED_LIMIT
from twinform.ir import Document, Joint, Limit, rewrite
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name
from twinform.passes.joints.check_limits import SoftLimits, limit_location, range_words, soft_limits

_BOUNDED = frozenset({"revolute", "prismatic"})


class TightenLimits(Pass):
    """Move the limits of joints inward: to the soft ones of a `<safety_controller>`, and by a margin.

    Changes revolute and prismatic joints whose name matches `joints`:

    1. with `soft`, a lower or upper limit that is outside of the soft one becomes that, also where it comes from a URDF
       file and travels in a carrier; one that is not written is made;
    2. limits that are written are moved inward by `margin`, on top of that.

    Never touches: limits that would move outward, the `<safety_controller>`, effort and velocity, or joints without
    an `<axis>`.
    Diagnostics: `tightened-limit` for each joint that it changes, and `untightened-limit` where no range would be left.
    With a margin it moves limits again when it runs again.
    """

    name = "tighten-limits"
    example: ClassVar[str] = 'tighten-limits{margin=0.02 joints="arm_*"}'

    soft: bool = Field(default=True, description="Whether soft limits become hard ones.")
    margin: float = Field(default=0.0, ge=0, allow_inf_nan=False, description="How far inward, in rad or m.")
    joints: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only joints"))

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with tighter limits."""
        return rewrite(document, Joint, lambda joint: self._tighten(joint, sink))

    def _tighten(self, joint: Joint, sink: DiagnosticSink) -> Joint:
        if joint.type not in _BOUNDED or joint.axis is None or not matches(joint.name, self.joints):
            return joint
        limit = joint.axis.limit or Limit()
        lower, upper = self._range(limit, (soft_limits(joint) if self.soft else None) or SoftLimits(None, None))
        if (lower, upper) == (limit.lower, limit.upper):
            return joint
        where = limit_location(joint, limit)
        was, now = (range_words(*ends) for ends in ((limit.lower, limit.upper), (lower, upper)))
        if lower is not None and upper is not None and lower >= upper:
            message = f"the limits of joint {joint.name!r} are left at {was}: {now} would leave no range"
            sink.report(UNTIGHTENED_LIMIT, message, where, found=was)
            return joint
        message = f"the limits of joint {joint.name!r} were {was} and are {now}"
        sink.report(TIGHTENED_LIMIT, message, where, found=was, expected=now)
        tight = limit.copy(lower=lower, upper=upper)
        return joint.copy(axis=joint.axis.copy(limit=tight))

    def _range(self, limit: Limit, soft: SoftLimits) -> tuple[float | None, float | None]:
        """The new lower and upper limit; None where there is none."""
        lower = max((each for each in (limit.lower, soft.lower) if each is not None), default=None)
        upper = min((each for each in (limit.upper, soft.upper) if each is not None), default=None)
        return _move_end(lower, self.margin), _move_end(upper, -self.margin)


def _move_end(end: float | None, by: float) -> float | None:
    return end if end is None or not by or math.isinf(end) else end + by
