"""Fill the limits, damping and friction that joints lack."""

from typing import ClassVar, Self

from pydantic import Field, model_validator

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import FILLED_LIMIT, UNFILLED_LIMIT
from twinform.ir import Axis, Document, Dynamics, Format, Joint, Limit, Node, rewrite
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name
from twinform.passes.joints.check_limits import limit_location

_BOUNDED = frozenset({"revolute", "prismatic"})
_DRIVEN = _BOUNDED | {"continuous"}


class FillLimits(Pass):
    """Fill limits, damping and friction that are missing with the user's values.

    Without options it changes nothing.

    Changes joints with one axis whose name matches `joints`:

    1. `effort` and `velocity` of revolute, prismatic and continuous joints;
    2. `lower` and `upper` of revolute and prismatic joints, unless the range would be upside down;
    3. where the whole `<limit>` is missing it is made, in URDF for joints without an `<axis>` too;
    4. `damping` and `friction` of the same joints as 1, and a whole `<dynamics>` where it is missing.

    Never touches: a value that is written, nor joints of SDF without an `<axis>`.
    Diagnostics: `filled-limit` for each joint that it fills, and `unfilled-limit` where case 2 left an end open.
    """

    name = "fill-limits"
    example: ClassVar[str] = 'fill-limits{effort=100 velocity=3.14 joints="arm_[0-9]"}'

    effort: float | None = Field(
        default=None, ge=0, allow_inf_nan=False, description="The greatest effort, in N m or N."
    )
    velocity: float | None = Field(
        default=None, ge=0, allow_inf_nan=False, description="The greatest speed, in rad/s or m/s."
    )
    lower: float | None = Field(
        default=None, allow_inf_nan=False, description="The lower end of the range, in rad or m."
    )
    upper: float | None = Field(
        default=None, allow_inf_nan=False, description="The upper end of the range, in rad or m."
    )
    damping: float | None = Field(
        default=None, ge=0, allow_inf_nan=False, description="The damping, in N m s/rad or N s/m."
    )
    friction: float | None = Field(
        default=None, ge=0, allow_inf_nan=False, description="The static friction, in N m or N."
    )
    joints: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only joints"))

    @model_validator(mode="after")
    def _check_range(self) -> Self:
        if self.lower is not None and self.upper is not None and self.lower > self.upper:
            raise ValueError("lower is above upper")
        return self

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with the limits filled."""
        return rewrite(document, Joint, lambda joint: self._fill(joint, document.format, sink))

    def _fill(self, joint: Joint, format_: Format, sink: DiagnosticSink) -> Joint:
        if joint.type not in _DRIVEN or not matches(joint.name, self.joints):
            return joint
        # In SDF, <limit> is part of <axis>, whose <xyz> nobody has written.
        if joint.axis is None and format_ is Format.SDF:
            return joint
        axis = joint.axis or Axis()
        limit = axis.limit or Limit()
        values = self._missing(joint.type, limit)
        if _is_upside_down(limit, values):
            _report_open_end(joint, limit, values, sink)
            values = {name: value for name, value in values.items() if name not in {"lower", "upper"}}
        dynamics = axis.dynamics or Dynamics()
        forces = self._missing_forces(dynamics)
        if not values and not forces:
            return joint
        _report_filled(joint, limit, values | forces, sink)
        update: dict[str, Node] = {"limit": limit.copy(**values)} if values else {}
        if forces:
            update["dynamics"] = dynamics.copy(**forces)
        return joint.copy(axis=axis.copy(**update))

    def _missing_forces(self, dynamics: Dynamics) -> dict[str, float]:
        """The values that the options give for forces which are not written."""
        chosen = {"damping": self.damping, "friction": self.friction}
        return {name: value for name, value in chosen.items() if value is not None and getattr(dynamics, name) is None}

    def _missing(self, type_: str, limit: Limit) -> dict[str, float]:
        """The values that the options give for limits which this type of joint has and which are not written."""
        chosen = {"effort": self.effort, "velocity": self.velocity}
        if type_ in _BOUNDED:
            chosen |= {"lower": self.lower, "upper": self.upper}
        return {name: value for name, value in chosen.items() if value is not None and getattr(limit, name) is None}


def _is_upside_down(limit: Limit, values: dict[str, float]) -> bool:
    """Whether the values would make the lower limit the greater one; a range that is written so does not count."""
    if not values.keys() & {"lower", "upper"}:
        return False
    lower, upper = values.get("lower", limit.lower), values.get("upper", limit.upper)
    return lower is not None and upper is not None and lower > upper


def _report_open_end(joint: Joint, limit: Limit, values: dict[str, float], sink: DiagnosticSink) -> None:
    open_end, written = ("upper", limit.lower) if limit.upper is None else ("lower", limit.upper)
    side = "below" if open_end == "upper" else "above"
    message = (
        f"the {open_end} limit of joint {joint.name!r} was not filled: "
        f"{values[open_end]:g} is {side} its other limit, {written:g}"
    )
    sink.report(UNFILLED_LIMIT, message, limit_location(joint, limit), found=f"{written:g}")


def _report_filled(joint: Joint, limit: Limit, values: dict[str, float], sink: DiagnosticSink) -> None:
    listed = ", ".join(f"{name} {value:g}" for name, value in values.items())
    sink.report(FILLED_LIMIT, f"limits of joint {joint.name!r} filled: {listed}", limit_location(joint, limit))
