"""Infinite limits, which are large numbers before SDF 1.10."""

import math
from functools import partial
from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Axis, Document, Joint, Opaque, rewrite
from twinform.ir.defaults import UNLIMITED, UNLIMITED_STRENGTH
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.nodes import text_piece
from twinform.schemas import format_value

_SINCE = (1, 10)
# Readers of older versions take this for no limit: rad or m, N m or N, rad/s or m/s. A range keeps
# its sign.
_UNLIMITED = {
    "lower": UNLIMITED, "upper": UNLIMITED, "effort": UNLIMITED_STRENGTH, "velocity": UNLIMITED_STRENGTH,
}  # fmt: skip


class BoundLimits(VersionPass):
    """Write infinite limits as the numbers that meant the same before 1.10.

    Changes: infinite `lower` and `upper` are -1e16 and 1e16, infinite `effort` and `velocity` are -1.
    Never touches: limits that are not written, which are none in any version.
    """

    name: ClassVar[str] = "bound-limits"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with finite limits."""
        return rewrite(document, Joint, partial(_bound_joint, keeper))


def _bound_joint(keeper: VersionKeeper, joint: Joint) -> Joint:
    for field in ("axis", "axis2"):
        axis: Axis | None = getattr(joint, field)
        if axis is not None and axis.limit is not None:
            joint = _bound_axis(keeper, joint, field, axis)
    return joint


def _bound_axis(keeper: VersionKeeper, joint: Joint, field: str, axis: Axis) -> Joint:
    limit = axis.limit
    infinite = {name: getattr(limit, name) for name in _UNLIMITED if _is_infinite(getattr(limit, name))}
    if limit is None or not infinite:
        return joint
    # Up to 1.9 the defaults of `lower` and `upper` are -1e16 and 1e16, and those of `effort` and
    # `velocity` -1.
    made = {name: _finite(name, value) for name, value in infinite.items()}
    bounded = axis.copy(limit=limit.copy(**made))
    pieces: list[Opaque] = [text_piece(name, format_value(value), f"{field}/limit") for name, value in infinite.items()]
    message = f"{' and '.join(infinite)} of joint {joint.name!r} are infinite"
    changed = joint.copy(**{field: bounded})
    return keeper.keep(
        changed, pieces, VersionCondition(since=_SINCE), rules.OTHER_WORDS, message, limit.location, len(pieces)
    )


def _is_infinite(value: float | None) -> bool:
    return value is not None and math.isinf(value)


def _finite(name: str, value: float) -> float:
    number = _UNLIMITED[name]
    return math.copysign(number, value) if number > 0 else number
