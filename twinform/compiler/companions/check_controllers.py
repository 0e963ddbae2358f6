"""Checks of the controllers of ros2_control: whether `<ros2_control>` has the interfaces that they claim."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from twinform.compiler.companions.name_places import Leaf, Step, is_made
from twinform.compiler.companions.robot_parts import DrivenJoint, RobotParts
from twinform.diagnostics import DiagnosticSink, Location, rules

_PARAMETERS = "ros__parameters"


class _Claim(NamedTuple):
    """The parameters that name joints, and the interfaces of each: one by its name, or those that a parameter lists."""

    joints: tuple[str, ...]
    commands: str = ""
    command_parameter: str = ""
    state_parameter: str = ""


_TRAJECTORY = _Claim(("joints",), command_parameter="command_interfaces", state_parameter="state_interfaces")
_WHEELS = _Claim(("left_wheel_names", "right_wheel_names"), commands="velocity")
_CLAIMS: Mapping[str, _Claim] = {
    "joint_trajectory_controller/JointTrajectoryController": _TRAJECTORY,
    "forward_command_controller/ForwardCommandController": _Claim(("joints",), command_parameter="interface_name"),
    "forward_command_controller/MultiInterfaceForwardCommandController": _Claim(
        ("joint",), command_parameter="interface_names"
    ),
    "position_controllers/JointGroupPositionController": _Claim(("joints",), commands="position"),
    "velocity_controllers/JointGroupVelocityController": _Claim(("joints",), commands="velocity"),
    "effort_controllers/JointGroupEffortController": _Claim(("joints",), commands="effort"),
    "position_controllers/GripperActionController": _Claim(("joint",), commands="position"),
    "effort_controllers/GripperActionController": _Claim(("joint",), commands="effort"),
    "parallel_gripper_action_controller/GripperActionController": _Claim(("joint",), commands="position"),
    "diff_drive_controller/DiffDriveController": _WHEELS,
    "admittance_controller/AdmittanceController": _TRAJECTORY._replace(command_parameter=""),
}
"""What the controllers of ros2_controllers claim, from their parameters."""

Parameters = Mapping[str, list[Step[Location]]]


def report_interfaces(leaves: Iterable[Leaf[Location]], robot: RobotParts, sink: DiagnosticSink) -> None:
    """Report interfaces that a controller claims and that no `<ros2_control>` of the robot has."""
    if not robot.is_controlled:
        return
    types, nodes = _types_and_nodes(leaves)
    # A controller whose joints have interfaces of another controller's is one of a chain.
    for name, kind in types.items():
        claim = _CLAIMS.get(kind)
        if claim is not None and name in nodes and "command_joints" not in nodes[name]:
            _report_claim(claim, nodes[name], robot, sink)


def _types_and_nodes(leaves: Iterable[Leaf[Location]]) -> tuple[dict[str, str], dict[str, Parameters]]:
    """Return the types of controllers by their names, and the parameters of nodes by theirs."""
    types: dict[str, str] = {}
    nodes: dict[str, dict[str, list[Step[Location]]]] = defaultdict(lambda: defaultdict(list))
    for leaf in leaves:
        steps = [each.text for each in leaf.path]
        if _PARAMETERS not in steps[1:]:
            continue
        at = steps.index(_PARAMETERS, 1)
        if steps[at + 2 :] == ["type"]:
            types[steps[at + 1]] = leaf.value.text
        elif len(steps) == at + 2:
            nodes[steps[at - 1].rpartition("/")[2]][steps[at + 1]].append(leaf.value)
    return types, {name: dict(each) for name, each in nodes.items()}


def _report_claim(claim: _Claim, node: Parameters, robot: RobotParts, sink: DiagnosticSink) -> None:
    joints = [each for name in claim.joints for each in node.get(name, ()) if each.text in robot.joints]
    for joint in joints:
        driven = robot.driven.get(joint.text)
        if driven is None:
            message = f"the joint {joint.text!r} is in no <ros2_control> of the robot, so nothing drives it"
            _report(message, joint, sink)
            continue
        for what, where in _missing(claim, node, joint, driven):
            message = f"the joint {joint.text!r} has no {what} in <ros2_control>, which this controller claims"
            _report(message, where, sink, _known(what, driven))


def _missing(
    claim: _Claim, node: Parameters, joint: Step[Location], driven: DrivenJoint
) -> Iterator[tuple[str, Step[Location]]]:
    """Yield the interfaces of a joint that are not there, and the values that ask for them."""
    if claim.commands and claim.commands not in driven.commands:
        yield f"command interface {claim.commands!r}", joint
    for each in node.get(claim.command_parameter, ()):
        if each.text not in driven.commands and not is_made(each.text):
            yield f"command interface {each.text!r}", each
    for each in node.get(claim.state_parameter, ()):
        if each.text not in driven.states and not is_made(each.text):
            yield f"state interface {each.text!r}", each


def _known(what: str, driven: DrivenJoint) -> str:
    names = driven.commands if what.startswith("command") else driven.states
    return f"it has {', '.join(sorted(names))}" if names else "it has none of that kind"


def _report(message: str, step: Step[Location], sink: DiagnosticSink, help: str | None = None) -> None:
    sink.report(rules.MISSING_INTERFACE, message, step.place, found=step.text, help=help)
