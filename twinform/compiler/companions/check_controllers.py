"""Checks of the controllers of ros2_control: whether `<ros2_control>` has the interfaces that they claim."""

from collections.abc import Iterable, Iterator, Mapping
from typing import NamedTuple

from twinform.compiler.companions.name_places import Leaf, Step, is_made
from twinform.compiler.companions.robot_parts import DrivenJoint, RobotParts
from twinform.diagnostics import DiagnosticSink, Location, nearest_name, rules

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
_CLASSES = (
    *_CLAIMS, "ackermann_steering_controller/AckermannSteeringController",
    "bicycle_steering_controller/BicycleSteeringController",
    "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster", "gpio_controllers/GpioCommandController",
    "imu_sensor_broadcaster/IMUSensorBroadcaster", "joint_state_broadcaster/JointStateBroadcaster",
    "mecanum_drive_controller/MecanumDriveController", "pid_controller/PidController",
    "pose_broadcaster/PoseBroadcaster", "range_sensor_broadcaster/RangeSensorBroadcaster",
    "tricycle_controller/TricycleController",
    "tricycle_steering_controller/TricycleSteeringController",
)  # fmt: skip
"""The controllers of ros2_controllers; robots have others of their own."""
_CLASS_TYPO = 0.9


_Parameters = dict[str, list[Step[Location]]]


class _Node(NamedTuple):
    """The name of a node where its parameters begin, and those that are values or lists."""

    key: Step[Location]
    parameters: _Parameters


def report_controllers(leaves: Iterable[Leaf[Location]], robot: RobotParts | None, sink: DiagnosticSink) -> None:
    """Report misspelt controllers, and interfaces that one claims and that no `<ros2_control>` of the robot has."""
    types, nodes = _types_and_nodes(leaves)
    for name, kind in types.items():
        _report_class(kind, sink)
        if name not in nodes and kind.text in _CLAIMS:
            _report_other_name(name, nodes, types, sink)
    if robot is None or not robot.is_controlled:
        return
    for name, kind in types.items():
        claim, node = _CLAIMS.get(kind.text), nodes.get(name)
        # A controller whose joints have interfaces of another controller's is one of a chain.
        if claim is not None and node is not None and "command_joints" not in node.parameters:
            _report_claim(claim, node.parameters, robot, sink)


def _report_class(kind: Step[Location], sink: DiagnosticSink) -> None:
    near = nearest_name(kind.text, _CLASSES, _CLASS_TYPO) if kind.text not in _CLASSES else None
    if near:
        message = f"the controller has the type {kind.text!r}, which ROS does not have; it has {near!r}"
        sink.report(rules.MISSPELLED_INTERFACE, message, kind.place, found=kind.text, help=f"did you mean {near!r}?")


def _report_other_name(
    name: str, nodes: Mapping[str, _Node], types: Mapping[str, Step[Location]], sink: DiagnosticSink
) -> None:
    """Report the parameters of a node that has no controller, where those of a controller of nearly its name lack."""
    near = nearest_name(name, [each for each in nodes if each not in types])
    if near:
        key = nodes[near].key
        message = f"there is no controller {near!r}: these are parameters of {name!r}, which has none"
        sink.report(rules.STALE_NAME, message, key.place, found=key.text, help=f"did you mean {name!r}?")


def _types_and_nodes(leaves: Iterable[Leaf[Location]]) -> tuple[dict[str, Step[Location]], dict[str, _Node]]:
    """Return the types of controllers by their names, and the nodes by theirs."""
    types: dict[str, Step[Location]] = {}
    nodes: dict[str, _Node] = {}
    for leaf in leaves:
        steps = [each.text for each in leaf.path]
        if _PARAMETERS not in steps[1:]:
            continue
        at = steps.index(_PARAMETERS, 1)
        if steps[at + 2 :] == ["type"]:
            types[steps[at + 1]] = leaf.value
        elif len(steps) > at + 1:
            node = nodes.setdefault(steps[at - 1].rpartition("/")[2], _Node(leaf.path[at - 1], {}))
            if len(steps) == at + 2:
                node.parameters.setdefault(steps[at + 1], []).append(leaf.value)
    return types, nodes


def _report_claim(claim: _Claim, node: _Parameters, robot: RobotParts, sink: DiagnosticSink) -> None:
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
    claim: _Claim, node: _Parameters, joint: Step[Location], driven: DrivenJoint
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
