"""Which joints are commanded, and how: by `<ros2_control>`, transmissions of ROS 1, and systems of Gazebo."""

from collections.abc import Iterator
from typing import Literal, NamedTuple, get_args

from twinform.ir import Element, Format, Model
from twinform.passes.joints.transmission import commands_of, read_transmission, urdf_elements

Interface = Literal["position", "velocity", "effort"]
INTERFACES: tuple[Interface, ...] = get_args(Interface)

_SYSTEMS: dict[str, tuple[Interface, tuple[str, ...]]] = {
    "JointPositionController": ("position", ("joint_name",)),
    "JointController": ("velocity", ("joint_name",)),
    "ApplyJointForce": ("effort", ("joint_name",)),
    "JointTrajectoryController": ("position", ("joint_name",)),
    "DiffDrive": ("velocity", ("left_joint", "right_joint")),
    "AckermannSteering": ("velocity", ("left_joint", "right_joint")),
}
"""Systems of gz-sim: what they command, and the parameters that name joints."""


class JointCommand(NamedTuple):
    """What a joint is commanded by, with the ends of the command and gains where they are written."""

    joint: str
    interface: Interface
    lower: float | None = None
    upper: float | None = None
    proportional: float | None = None
    derivative: float | None = None


def joint_commands(model: Model, format_: Format) -> dict[str, JointCommand]:
    """The first command of each joint, by its name: of ros2_control, then of a transmission, then of a system."""
    found: dict[str, JointCommand] = {}
    for each in (*_of_ros2_control(model, format_), *_of_transmissions(model, format_), *_of_systems(model)):
        found.setdefault(each.joint, each)
    return found


def _of_ros2_control(model: Model, format_: Format) -> Iterator[JointCommand]:
    for _, system in urdf_elements(model, format_, "ros2_control"):
        for joint in system.children:
            if joint.name != "joint":
                continue
            for each in joint.children:
                name = each.get("name")
                if each.name == "command_interface" and name in INTERFACES:
                    ends = (_parameter(each, end) for end in ("min", "max"))
                    yield JointCommand(joint.get("name") or "", name, *ends)


def _of_transmissions(model: Model, format_: Format) -> Iterator[JointCommand]:
    for _, element in urdf_elements(model, format_, "transmission"):
        for end in read_transmission(element).joints:
            for interface in end.interfaces:
                for command in commands_of(interface) or ():
                    if command in INTERFACES:
                        yield JointCommand(end.name, command)


def _of_systems(model: Model) -> Iterator[JointCommand]:
    systems = [(plugin.name, plugin.content) for plugin in model.plugins]
    systems += [
        (each.get("name"), each.children)
        for extension in model.extensions
        for each in extension.content
        if each.name == "plugin"
    ]
    for name, content in systems:
        known = _SYSTEMS.get((name or "").rpartition("::")[2])
        if known is None:
            continue
        interface, parameters = known
        gains = {each.name: _number(each.text) for each in content}
        for each in content:
            if each.name in parameters and each.text:
                p, d = (gains.get(key) if interface == "position" else None for key in ("p_gain", "d_gain"))
                yield JointCommand(each.text.strip(), interface, None, None, p, d)


def _parameter(interface: Element, name: str) -> float | None:
    found = (each for each in interface.find_all("param") if each.get("name") == name)
    return next((_number(each.text) for each in found), None)


def _number(text: str | None) -> float | None:
    """The number in a text; None where there is none, as where a macro has still to be expanded."""
    try:
        return None if text is None else float(text)
    except ValueError:
        return None
