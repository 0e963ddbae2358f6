"""Give joints actuators of MuJoCo."""

import math
from collections.abc import Iterable, Iterator
from typing import ClassVar, Literal

from pydantic import Field

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import ASSUMED_GAIN
from twinform.ir import Document, Element, Joint, Limit, Model, Opaque, rewrite
from twinform.ir.defaults import UNLIMITED
from twinform.passes.carriers.carriers import KEPT, declare_carriers
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name
from twinform.passes.joints.joint_commands import Interface, JointCommand, joint_commands
from twinform.schemas import format_value

_DRIVEN = frozenset({"revolute", "continuous", "prismatic"})
_TAGS: dict[Interface, str] = {"position": "position", "velocity": "velocity", "effort": "motor"}
_STIFF: dict[str, float] = {"prismatic": 1000.0}
"""In N/m; and of joints that turn in N m/rad, where no effort is written."""
_STIFFNESS = 100.0
_SLACK: dict[str, float] = {"prismatic": 0.01}
"""The error of the position at which an actuator pulls with the whole effort: in m, and of joints that turn in rad."""
_TURN_SLACK = 0.1
_DRAG = 10.0
"""In N m s/rad or N s/m, where effort or speed are not written."""


class AddActuators(Pass):
    """Give joints the actuators that MuJoCo moves them by, for the conversion to MJCF.

    MJCF has no interfaces for commands: what moves a joint is an actuator, with gains of its own. URDF and SDF say what
    is commanded, and seldom the gains. So they are options, and what is not given comes from the limits of the joint.

    Changes models, nested ones too, which keep the actuators in an element of our own namespace:

    1. a joint that `<ros2_control>` commands, or a `<transmission>`, or a system of gz-sim such as
       `JointPositionController` or `DiffDrive`, gets an actuator of the name of the joint: `position`, `velocity`, or
       `motor` for efforts; the first command of a joint counts;
    2. with `interface`, every joint that can move gets one, whatever commands it;
    3. `kp` of a position is the effort divided by 0.1 rad or 0.01 m, so that it pulls fully at that error, or 100 N
       m/rad or 1000 N/m where no effort is written; the damping is that of `damping-ratio` at the drawn pose;
    4. `kv` of a velocity is the effort divided by the greatest speed, or 10 where one of them is not written;
    5. the range of the control is that of the command interface, or of the limits of the joint;
    6. the model asks for the integrator `implicitfast`, which stays stable with stiff actuators.

    The control is the command of the joint, behind its transmission: a reduction is not applied again.

    Never touches: joints that mimic another, of more than one axis, or that have an actuator already.
    Diagnostics: `assumed-gain` for each joint whose gain nobody has written.
    """

    name = "add-actuators"
    example: ClassVar[str] = "add-actuators{kp=200 damping-ratio=0.7}"

    kp: float | None = Field(default=None, gt=0, allow_inf_nan=False, description="The stiffness of positions.")
    kv: float | None = Field(default=None, gt=0, allow_inf_nan=False, description="The gain of velocities.")
    damping_ratio: float = Field(
        default=1.0, ge=0, allow_inf_nan=False, description="The damping of positions; 1 is critical."
    )
    interface: Literal["position", "velocity", "effort"] | None = Field(
        default=None, description="What all joints are commanded by, whether something commands them or not."
    )
    joints: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only joints"))

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with actuators."""

        def add(model: Model) -> Model:
            commands = self._commands(model, joint_commands(model, document.format))
            made = [_Actuator(joint, command, self).element(sink) for joint, command in commands]
            return _with_actuators(model, made) if made else model

        changed = rewrite(document, Model, add)
        return document if changed is document else declare_carriers(changed)

    def _commands(self, model: Model, known: dict[str, JointCommand]) -> Iterator[tuple[Joint, JointCommand]]:
        """Yield the joints that get an actuator, with what commands them."""
        has_one = set(_actuated(model))
        for joint in model.joints:
            command = known.get(joint.name)
            if self.interface is not None:
                command = JointCommand(joint.name, self.interface)
            mimics = joint.axis is not None and joint.axis.mimic is not None
            if command is None or joint.type not in _DRIVEN or mimics or joint.name in has_one:
                continue
            if matches(joint.name, self.joints):
                yield joint, command


@dataclass(frozen=True, slots=True)
class _Actuator:
    """One actuator, of a joint and its command."""

    joint: Joint
    command: JointCommand
    options: AddActuators

    def element(self, sink: DiagnosticSink) -> Element:
        """The element of MJCF."""
        name = self.joint.name
        attributes = [("name", name), ("joint", name), *self._gains(sink), *self._range()]
        return Element.unchecked(name=_TAGS[self.command.interface], attributes=tuple(attributes))

    @property
    def _limit(self) -> Limit:
        found = self.joint.axis.limit if self.joint.axis else None
        return found or Limit.unchecked()

    def _gains(self, sink: DiagnosticSink) -> Iterator[tuple[str, str]]:
        match self.command.interface:
            case "position":
                yield "kp", format_value(self._stiffness(sink))
                if self.command.derivative is not None and self.options.kp is None:
                    yield "kv", format_value(self.command.derivative)
                else:
                    yield "dampratio", format_value(self.options.damping_ratio)
            case "velocity":
                yield "kv", format_value(self._drag(sink))
            case "effort":
                return

    def _stiffness(self, sink: DiagnosticSink) -> float:
        written = self.options.kp or self.command.proportional
        if written:
            return written
        effort, kind = _finite(self._limit.effort), self.joint.type
        stiffness = effort / _SLACK.get(kind, _TURN_SLACK) if effort else _STIFF.get(kind, _STIFFNESS)
        self._report(sink, "kp", stiffness)
        return stiffness

    def _drag(self, sink: DiagnosticSink) -> float:
        if self.options.kv:
            return self.options.kv
        effort, speed = _finite(self._limit.effort), _finite(self._limit.velocity)
        # A greater one would only pull with the whole effort, this way and that: such a motor never comes to rest.
        drag = effort / speed if effort and speed else _DRAG
        self._report(sink, "kv", drag)
        return drag

    def _report(self, sink: DiagnosticSink, gain: str, value: float) -> None:
        message = f"the actuator of joint {self.joint.name!r} has {gain} {value:g}, which nobody has written"
        sink.report(ASSUMED_GAIN, message, self.joint.location, found=self.joint.name)

    def _range(self) -> Iterator[tuple[str, str]]:
        lower, upper = self.command.lower, self.command.upper
        match self.command.interface:
            case "position" if self.joint.type != "continuous":
                ends = (self._limit.lower, self._limit.upper)
            case "velocity":
                ends = _about_zero(self._limit.velocity)
            case "effort":
                ends = _about_zero(self._limit.effort)
            case _:
                ends = (None, None)
        first, last = (_bounded(own, usual) for own, usual in zip((lower, upper), ends, strict=True))
        if first is not None and last is not None and first < last:
            yield "ctrllimited", "true"
            yield "ctrlrange", format_value((first, last))


def _about_zero(most: float | None) -> tuple[float | None, float | None]:
    return (None, None) if most is None or most < 0 else (-most, most)


def _bounded(own: float | None, usual: float | None) -> float | None:
    """The end of a range: its own, or the usual one; None where neither is written or it has no end."""
    end = usual if own is None else own
    return end if end is not None and math.isfinite(end) and abs(end) < UNLIMITED else None


def _finite(value: float | None) -> float | None:
    """A limit that is one: above zero, and below what stands for infinity."""
    return value if value is not None and 0 < value < UNLIMITED else None


def _actuated(model: Model) -> Iterator[str | None]:
    """Yield the joints that have an actuator in what a model keeps of MJCF."""
    for part in model.opaque:
        if part.element is not None and part.element.name == KEPT:
            for section in part.element.children:
                if section.name == "actuator":
                    yield from (each.get("joint") for each in section.children)


def _with_actuators(model: Model, actuators: Iterable[Element]) -> Model:
    option = Element.unchecked(name="option", attributes=(("integrator", "implicitfast"),))
    section = Element.unchecked(name="actuator", children=tuple(actuators))
    kept = Element.unchecked(name=KEPT, children=(option, section))
    return model.copy(opaque=(*model.opaque, Opaque.unchecked(element=kept)))
