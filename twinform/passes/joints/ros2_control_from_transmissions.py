"""Convert transmissions of ROS 1 to `<ros2_control>`."""

from collections.abc import Iterable
from dataclasses import field
from typing import ClassVar

from pydantic import Field

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, Location, rules
from twinform.ir import Element, Format, Joint, Model, Opaque
from twinform.passes.joints.ros2_control import (
    MakeRos2Control,
    command_element,
    controlled_joints,
    joint_element,
    system_element,
)
from twinform.passes.joints.transmission import (
    PLUGINS,
    Transmission,
    as_parts,
    commands_of,
    location_of,
    read_transmission,
    replace_parts,
    urdf_elements,
    write_ros2_transmission,
)

_UNMOVABLE = frozenset({"fixed", "floating", "planar"})


class Ros2ControlFromTransmissions(MakeRos2Control):
    """Turn the transmissions of ROS 1 into one `<ros2_control>` system for each model.

    Changes models with `<transmission>` elements, nested models and those of worlds too; a model of SDF has them in
    carriers, and so stands what is made of them:

    1. every joint gets the command interfaces that its `hardwareInterface` elements stand for, and the state interfaces
       position, velocity and effort, which every joint of ros_control has;
    2. every transmission stands in the system, with ends, roles, reductions and offsets; the reduction of a simple one
       moves from the actuator to the joint, where ROS 2 reads it; its other content becomes its parameters;
    3. older types (`SimpleTransmission`, those of the PR2) become the simple transmission of ROS 2;
    4. a joint that mimics another gets no command interface: its leader is commanded.

    Never touches: a transmission of joints that the model does not have, that cannot move, or that a `<ros2_control>`
    commands already, nor the plugins of a simulator; `migrate-gazebo-classic` changes those. A transmission of which
    other programs read parts that ROS 2 cannot express stays beside the new one.
    Diagnostics: `converted-transmission`, `unconverted-transmission`, `foreign-transmission` and
    `foreign-hardware-interface`; each transmission that went has an entry of the ledger, *approximated*.
    """

    name = "ros2-control-from-transmissions"
    example: ClassVar[str] = "ros2-control-from-transmissions{hardware=mock_components/GenericSystem}"

    keep: bool = Field(default=False, description="Whether the transmissions stay as well, for programs of ROS 1.")

    def convert(self, model: Model, format_: Format, sink: DiagnosticSink) -> Model:
        """One model with a system in place of its transmissions."""
        found = [(part, read_transmission(element)) for part, element in urdf_elements(model, format_, "transmission")]
        work = _ModelRun(model, format_, sink)
        taken = [(part, each) for part, each in found if work.check(part, each)]
        if not taken:
            return model
        system = self._system(model, format_, work.joints(taken), [each for _, each in taken])
        # What only other programs read in a transmission has no place in <ros2_control>, so such a
        # one stays beside its successor.
        gone = [part for part, each in taken if not (self.keep or each.foreign)]
        for part, each in taken:
            work.account(part, each, stays=part not in gone)
        return replace_parts(model, gone, as_parts([system], format_), after=taken[-1][0])

    def _system(
        self, model: Model, format_: Format, joints: Iterable[Element], transmissions: Iterable[Transmission]
    ) -> Element:
        parts = (*joints, *map(write_ros2_transmission, transmissions))
        return system_element(model, format_, self.system, self.hardware, parts)


@dataclass()
class _ModelRun:
    """The conversion of one model."""

    model: Model
    format: Format
    sink: DiagnosticSink
    known: dict[str, Joint] = field(init=False)
    controlled: dict[str, str] = field(init=False)

    def __post_init__(self) -> None:
        self.known = {joint.name: joint for joint in self.model.joints}
        self.controlled = controlled_joints(self.model, self.format)

    def check(self, part: Opaque, transmission: Transmission) -> bool:
        """Whether a transmission can be expressed in ROS 2; reports why not."""
        reason = self._find_obstacle(transmission)
        if reason:
            message = f"transmission {transmission.name!r} is not converted: {reason}"
            self.sink.report(rules.UNCONVERTED_TRANSMISSION, message, self._place(part), found=transmission.name)
        return not reason

    def joints(self, taken: Iterable[tuple[Opaque, Transmission]]) -> list[Element]:
        """The joints of the system, in the order of the transmissions, each once."""
        commands: dict[str, list[str]] = {}
        for part, transmission in taken:
            for end in transmission.joints:
                listed = commands.setdefault(end.name, [])
                for interface in end.interfaces:
                    listed += self._commands(part, end.name, interface)
        return [joint_element(name, map(command_element, dict.fromkeys(listed))) for name, listed in commands.items()]

    def account(self, part: Opaque, transmission: Transmission, *, stays: bool) -> None:
        """Report and account for one converted transmission."""
        where, name = self._place(part), transmission.name
        message = f"transmission {name!r} became a part of a ros2_control system"
        self.sink.report(rules.CONVERTED_TRANSMISSION, message, where, found=name)
        if transmission.type not in PLUGINS:
            kind = f"{transmission.type!r}" if transmission.type else "no type"
            message = f"transmission {name!r} has the type {kind}, which only another package can provide"
            self.sink.report(rules.FOREIGN_TRANSMISSION, message, where, found=transmission.type or None)
        if transmission.foreign:
            names = ", ".join(dict.fromkeys(_local_tag(each) for each in transmission.foreign))
            message = f"transmission {name!r} is kept beside <ros2_control>: other programs read its {names}"
            self.sink.report(rules.UNCONVERTED_TRANSMISSION, message, where, found=names)
        if not stays:
            weight = part.weight if self.format is Format.URDF else part.weight - 1  # the carrier is not of the source
            message = f"transmission {name!r} is written as a part of <ros2_control>"
            self.sink.account(Fate.APPROXIMATED, rules.CONVERTED_TRANSMISSION, message, where, weight)

    def _find_obstacle(self, transmission: Transmission) -> str:
        if not transmission.joints:
            return "it has no joint"
        for end in transmission.joints:
            joint = self.known.get(end.name)
            if joint is None:
                return f"there is no joint {end.name!r}"
            if joint.type in _UNMOVABLE:
                return f"joint {end.name!r} is {joint.type}"
            if end.name in self.controlled:
                return f"joint {end.name!r} is in the ros2_control {self.controlled[end.name]!r} already"
        return ""

    def _commands(self, part: Opaque, joint: str, interface: str) -> tuple[str, ...]:
        commands = commands_of(interface)
        if commands is None:
            message = f"joint {joint!r} has the interface {interface!r}, which ros2_control does not have"
            self.sink.report(rules.FOREIGN_HARDWARE_INTERFACE, message, self._place(part), found=interface)
            return ()
        # An error in ros2_control (component_parser.cpp): a joint that mimics takes no command
        # interface.
        if commands and self._mimics(joint):
            message = f"joint {joint!r} mimics another, so ros2_control takes no commands for it"
            self.sink.report(rules.FOREIGN_HARDWARE_INTERFACE, message, self._place(part), found=interface)
            return ()
        return commands

    def _mimics(self, joint: str) -> bool:
        axis = self.known[joint].axis
        return axis is not None and axis.mimic is not None

    def _place(self, part: Opaque) -> Location:
        return location_of(part, self.model)


def _local_tag(name: str) -> str:
    return f"<{name.rpartition('}')[2]}>"
