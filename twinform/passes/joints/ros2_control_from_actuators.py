"""Make a `<ros2_control>` of the actuators of MuJoCo: command interfaces, and how far and hard they reach."""

import math
from collections.abc import Iterator, Sequence
from typing import ClassVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import FOREIGN_HARDWARE_INTERFACE
from twinform.ir import Element, Format, Joint, Model, Opaque
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.carriers.carriers import KEPT
from twinform.passes.joints.joint_commands import Interface
from twinform.passes.joints.ros2_control import (
    MakeRos2Control,
    command_element,
    controlled_joints,
    joint_element,
    system_element,
)
from twinform.passes.joints.transmission import as_parts
from twinform.schemas import format_value

_NAME_IN_URDF = "name"
_BY_TAG: dict[str, Interface] = {
    "position": "position", "intvelocity": "velocity", "velocity": "velocity", "motor": "effort",
}  # fmt: skip
_DRIVEN = frozenset({"revolute", "continuous", "prismatic", "screw"})
Ends = tuple[float, float]


class Ros2ControlFromActuators(MakeRos2Control):
    """Make a `<ros2_control>` system of the actuators that a model has of MuJoCo, for the conversion of MJCF to URDF.

    Changes models with actuators of MJCF, which they keep in an element of our own namespace:

    1. a joint gets a command interface for each kind of actuator on it: `position` of a `position` actuator, `velocity`
       of `velocity` and `intvelocity`, `effort` of a `motor`; of a `general` one, by its bias: that with a stiffness is
       a position, that with damping alone a velocity, and that without any an effort;
    2. the ends of the control become `min` and `max` of the interface, in the units of the joint: a `gear` divides
       positions and velocities, and multiplies efforts; efforts end at `forcerange` too;
    3. every joint gets the state interfaces position, velocity and effort.

    The greatest effort of a joint needs no pass: it comes from `actuatorfrcrange`, or from what its actuators can do.
    The actuators stay, so that the way back to MJCF has them as they were.
    Never touches: a joint that a `<ros2_control>` has already, or that follows another one.
    Diagnostics: `foreign-hardware-interface` for muscles, and all that has no interface in ros2_control.
    """

    name = "ros2-control-from-actuators"
    example: ClassVar[str] = "ros2-control-from-actuators{hardware=mujoco_ros2_control/MujocoSystemInterface}"

    def convert(self, model: Model, format_: Format, sink: DiagnosticSink) -> Model:
        """One model with a system beside its actuators."""
        actuators = list(_actuators(model))
        if not actuators:
            return model
        commands: dict[str, dict[Interface, Element]] = {}
        named = _joints_by_name(model)
        done = controlled_joints(model, format_)
        for element in actuators:
            joint = named.get(element.get("joint") or "")
            if joint is None or joint.name in done or not _may_be_commanded(joint):
                continue
            actuator = _Actuator(element, joint)
            interface = actuator.interface
            if interface is None:
                message = f"actuator <{element.name}> of joint {joint.name!r} has no interface in ros2_control"
                sink.report(FOREIGN_HARDWARE_INTERFACE, message, joint.location, found=element.name)
            else:
                of_joint = commands.setdefault(joint.name, {})
                of_joint.setdefault(interface, command_element(interface, actuator.ends(interface)))
        if not commands:
            return model
        joints = [joint_element(name, each.values()) for name, each in commands.items()]
        system = system_element(model, format_, self.system, self.hardware, joints)
        return model.copy(opaque=(*model.opaque, *as_parts([system], format_)))


def _actuators(model: Model) -> Iterator[Element]:
    """Yield the actuators that a model keeps of MJCF."""
    kept: list[Opaque] = [part for part in model.opaque if part.element is not None and part.element.name == KEPT]
    for part in kept:
        for section in part.element.children if part.element else ():
            if section.name == "actuator":
                yield from section.children


def _joints_by_name(model: Model) -> dict[str, Joint]:
    """Map the names that joints have, and those that they have in MJCF, to the joints."""
    found = {joint.name: joint for joint in model.joints}
    for joint in model.joints:
        changed = find_annotation(joint, _NAME_IN_URDF)
        if changed is not None and changed.text and changed.get("instead_of") == joint.name:
            found.setdefault(changed.text, joint)
    return found


def _may_be_commanded(joint: Joint) -> bool:
    mimics = joint.axis is not None and joint.axis.mimic is not None
    return joint.type in _DRIVEN and not mimics


@dataclass(frozen=True, slots=True)
class _Actuator:
    """An actuator of MJCF on a joint."""

    element: Element
    joint: Joint

    @property
    def interface(self) -> Interface | None:
        """What it is commanded by; None where ros2_control has no word for that."""
        if self.element.name != "general":
            return _BY_TAG.get(self.element.name)
        # the force is gain * control + bias, and the bias is constant + stiffness * position + damping * velocity
        if {self.element.get("gaintype"), self.element.get("biastype")} - {None, "fixed", "none", "affine"}:
            return None
        if (self.element.get("dyntype") or "none") != "none":
            return None
        _, stiffness, damping = (*self._numbers("biasprm"), 0.0, 0.0, 0.0)[:3]
        if self.element.get("biastype") != "affine" or (stiffness == 0 and damping == 0):
            return "effort"
        return "position" if stiffness != 0 else "velocity"

    def ends(self, interface: Interface) -> Sequence[tuple[str, str]]:
        """The ends of the command, in the units of the joint; nothing where it has none."""
        control = self._range("ctrl") or self._inherited()
        if control is None and interface != "effort":
            return ()
        gear = next(iter(self._numbers("gear")), 1.0)
        scale = self._gain * gear if interface == "effort" else self._gain / self._feedback(interface) / gear
        ends = [control] if control is not None else []
        found = [_ordered(first * scale, last * scale) for first, last in ends]
        force = self._range("force")
        if interface == "effort" and force is not None:
            found.append(_ordered(force[0] * gear, force[1] * gear))
        if not found:
            return ()
        lower, upper = max(first for first, _ in found), min(last for _, last in found)
        return [(key, format_value(end)) for key, end in (("min", lower), ("max", upper)) if math.isfinite(end)]

    @property
    def _gain(self) -> float:
        """What the control is multiplied by, of a `general` actuator; others have the gain of their feedback."""
        return next(iter(self._numbers("gainprm")), 1.0) if self.element.name == "general" else 1.0

    def _feedback(self, interface: Interface) -> float:
        """What takes position or velocity off the control, of a `general` actuator."""
        if self.element.name != "general":
            return 1.0
        return -(*self._numbers("biasprm"), 0.0, 0.0, 0.0)[1 if interface == "position" else 2]

    def _range(self, kind: str) -> Ends | None:
        """The `ctrlrange` or `forcerange`, where it counts."""
        ends = self._numbers(f"{kind}range")
        if len(ends) != 2 or self.element.get(f"{kind}limited") == "false" or ends[0] >= ends[1]:
            return None
        return ends[0], ends[1]

    def _inherited(self) -> Ends | None:
        """The range of the joint, as wide as `inheritrange` says."""
        share = next(iter(self._numbers("inheritrange")), 0.0)
        limit = self.joint.axis.limit if self.joint.axis else None
        if share <= 0 or limit is None or limit.lower is None or limit.upper is None:
            return None
        middle, half = (limit.lower + limit.upper) / 2, share * (limit.upper - limit.lower) / 2
        return middle - half, middle + half

    def _numbers(self, name: str) -> tuple[float, ...]:
        return tuple(map(float, (self.element.get(name) or "").split()))


def _ordered(one: float, other: float) -> Ends:
    return min(one, other), max(one, other)
