"""The controllers that the interfaces of a model call for, with the parameters of ros2_controllers.

Wheels may be a differential drive, whose measures are taken from the model.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field

from twinform.compiler.packaging.gazebo_control import Component, System, runs_in_gazebo, systems_of
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format, Model
from twinform.lazy import lazy_pattern
from twinform.passes.plugins.wheels import NotMeasuredError, Wheel, base_link, radius_of, separation_of, wheel
from twinform.passes.plugins.yaml_text import Value, yaml_text

_RATE = 100
"""The rate of controllers, in Hz, where none is given."""
_STRANGE = lazy_pattern(r"[^A-Za-z0-9_]+")
_LONGEST = 100
_FORWARDED = ("velocity", "effort")
"""Commands that go on as they come: what a trajectory needs beside them are gains, which nobody can guess."""
_UNMOVED = frozenset({"fixed", "floating", "planar"})
_NAMING = ("joints", "left_wheel_names", "right_wheel_names", "sensor_name")
"""The parameters that name joints and sensors."""
_FORTRESS = "fortress"
"""Its ROS, Humble, knows nothing of mimics in a URDF; later ones move such joints themselves."""
_BROADCASTERS: Mapping[str, str] = {
    "orientation.": "imu_sensor_broadcaster/IMUSensorBroadcaster",
    "angular_velocity.": "imu_sensor_broadcaster/IMUSensorBroadcaster",
    "force.": "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
    "torque.": "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
}
"""The broadcaster for the values of a sensor, by the beginning of the names of its interfaces."""

_HEAD = """\
# Controllers for the interfaces in the <ros2_control> of the robot.
# launch/gazebo.launch.py starts those that its list names.
"""


@dataclass(frozen=True, slots=True)
class Controller:
    """A controller: its name, its class for pluginlib, and its parameters."""

    name: str
    type: str
    parameters: Mapping[str, Value] = field(default_factory=dict[str, Value])

    def parts(self) -> frozenset[str]:
        """Return the joints and sensors that it names; a broadcaster of all joints names none."""
        named = (self.parameters.get(key, ()) for key in _NAMING)
        return frozenset(
            str(part) for each in named for part in ((each,) if isinstance(each, str) else _as_sequence(each))
        )

    @property
    def package(self) -> str:
        """The ROS package that it comes in."""
        return self.type.partition("/")[0]


def controllers_of(document: Document, sink: DiagnosticSink, release: str = "harmonic") -> tuple[Controller, ...]:
    """Return a broadcaster of joint states, and the controllers for joints and sensors of a document of one model.

    `release` is the one of Gazebo, which goes with a distribution of ROS.

    1. wheels that are a differential drive: `diff_drive_controller`;
    2. positions: one `joint_trajectory_controller` for each system;
    3. other velocities and efforts: one `forward_command_controller` for each system and interface;
    4. sensors for motion and for forces: a broadcaster for each.
    """
    model = document.models[0]
    systems = systems_of(model, document.format)
    if not systems:
        return ()
    groups = _group_joints(model, systems, release, sink)
    found = [Controller("joint_state_broadcaster", "joint_state_broadcaster/JointStateBroadcaster")]
    drive, wheels = _drive_controller(document, groups, sink)
    found += drive
    for group, joints in groups.items():
        found += _command_controllers(group, [joint for joint in joints if joint.name not in wheels])
    # Interfaces say what a joint takes, not what it is for. Positions have one usual controller;
    # velocities and efforts have one without gains. A trajectory controller for these needs gains,
    # and gains that nobody has measured are worse than none.
    found += [each for system in systems for each in _broadcasters(model, system, sink)]
    return tuple(_with_unique_names(found))


def controllers_yaml(controllers: Sequence[Controller]) -> str:
    """Write the parameters of the controller manager and its controllers."""
    types: dict[str, Value] = {each.name: {"type": each.type} for each in controllers}
    parts: list[Mapping[str, Value]] = [{"controller_manager": {"ros__parameters": {"update_rate": _RATE, **types}}}]
    parts += [{each.name: {"ros__parameters": each.parameters}} for each in controllers if each.parameters]
    return _HEAD + "\n".join(map(yaml_text, parts))


def controllers_in_gazebo(controllers: Iterable[Controller], document: Document, release: str) -> list[Controller]:
    """Return the controllers whose hardware the release of Gazebo loads."""
    systems = systems_of(document.models[0], document.format)
    of = {runs: {part for each in systems if runs_in_gazebo(each, release) is runs for part in each.parts()}
          for runs in (True, False)}  # fmt: skip
    return [each for each in controllers if each.parts().isdisjoint(of[False] - of[True])]


def _group_joints(
    model: Model, systems: Iterable[System], release: str, sink: DiagnosticSink
) -> dict[str, list[Component]]:
    """Group the joints that can be commanded by their system; joints of single actuators are one group."""
    moving = {joint.name for joint in model.joints if joint.type not in _UNMOVED}
    knows_mimics = release != _FORTRESS
    following = {each.name for each in model.joints if each.axis and each.axis.mimic and knows_mimics}
    groups: dict[str, list[Component]] = {}
    several = sum(system.kind == "system" for system in systems) > 1
    for system in systems:
        group = groups.setdefault(system.name if several and system.kind == "system" else "", [])
        for each in system.joints:
            reason = _reason_against(each, moving, following)
            if reason:
                message = f"no controller is written for joint {each.name!r}: {reason}"
                sink.report(rules.UNCONTROLLED_JOINT, message, system.location, found=each.name)
            elif each.commands:
                group.append(each)
        for gpio in system.gpios:
            message = f"no controller is written for gpio {gpio.name!r}: what its values mean is not known"
            sink.report(rules.UNCONTROLLED_JOINT, message, system.location, found=gpio.name)
    return groups


def _reason_against(joint: Component, moving: set[str], following: set[str]) -> str:
    if joint.name not in moving:
        return "the robot has no joint of this name that moves"
    if joint.commands and joint.name in following and not joint.alone:
        return "it mimics another one, and the controller manager stops where such a joint has a <command_interface>"
    if joint.commands and not {"position", *_FORWARDED} & set(joint.commands):
        return f"its commands are {', '.join(joint.commands)}, none of position, velocity and effort"
    return ""


def _drive_controller(
    document: Document, groups: Mapping[str, Sequence[Component]], sink: DiagnosticSink
) -> tuple[list[Controller], frozenset[str]]:
    """Return the controller of a differential drive, if there is one, and the joints that it commands."""
    model = document.models[0]
    # A wheel turns without end; a revolute joint that takes velocities is part of an arm.
    endless = {joint.name for joint in model.joints if joint.type == "continuous"}
    commanded = [each for group in groups.values() for each in group]
    joints = [each.name for each in commanded if _is_spun(each) and each.name in endless]
    if len(joints) < 2:
        return [], frozenset()
    others = [each.name for each in commanded if each.name not in joints]
    try:
        drive = differential_drive(model, joints, others, document.format)
    except NotMeasuredError as error:
        message = f"joints {', '.join(map(repr, joints))} get no differential drive: {error}"
        sink.report(rules.NO_DIFFERENTIAL_DRIVE, message, model.location)
        return [], frozenset()
    parameters: dict[str, Value] = {
        "left_wheel_names": drive.left,
        "right_wheel_names": drive.right,
        "wheel_separation": drive.separation,
        "wheel_radius": drive.radius,
        "odom_frame_id": "odom",
        "base_frame_id": base_link(model, document.format),
    }
    if not all("position" in each.states for each in commanded if each.name in joints):
        parameters["position_feedback"] = False
    kind = "diff_drive_controller"
    return [Controller(kind, f"{kind}/DiffDriveController", parameters)], frozenset(joints)


def _is_spun(joint: Component) -> bool:
    return "velocity" in joint.commands and "position" not in joint.commands


def _command_controllers(group: str, joints: Sequence[Component]) -> Iterator[Controller]:
    prefix = f"{_ros_name(group)}_" if group else ""
    led = [each for each in joints if "position" in each.commands and "position" in each.states]
    if led:
        speeds = all("velocity" in each.states for each in led)
        parameters: dict[str, Value] = {
            "joints": [each.name for each in led],
            "command_interfaces": ["position"],
            "state_interfaces": ["position", "velocity"] if speeds else ["position"],
        }
        kind = "joint_trajectory_controller"
        yield Controller(f"{prefix}{kind}", f"{kind}/JointTrajectoryController", parameters)
    rest = [each for each in joints if each not in led]
    for interface in ("position", *_FORWARDED):
        names = [each.name for each in rest if _interface(each) == interface]
        if names:
            parameters = {"joints": names, "interface_name": interface}
            kind = "forward_command_controller"
            yield Controller(f"{prefix}forward_{interface}_controller", f"{kind}/ForwardCommandController", parameters)


def _interface(joint: Component) -> str:
    """Return the interface by which a joint is commanded."""
    return next(each for each in ("position", *_FORWARDED) if each in joint.commands)


def _broadcasters(model: Model, system: System, sink: DiagnosticSink) -> Iterator[Controller]:
    links = {link.name for link in model.links}
    for sensor in system.sensors:
        types = [type_ for begin, type_ in _BROADCASTERS.items() if _has(sensor, begin)]
        frame = sensor.parameter("frame_id") or (sensor.name if sensor.name in links else None)
        if types and frame:
            name = f"{_ros_name(sensor.name)}_broadcaster"
            yield Controller(name, types[0], {"sensor_name": sensor.name, "frame_id": frame})
        else:
            reason = "its values are those of no sensor known" if not types else "it names no frame"
            message = f"no broadcaster is written for sensor {sensor.name!r}: {reason}"
            sink.report(rules.UNCONTROLLED_JOINT, message, system.location, found=sensor.name)


def _as_sequence(value: Value) -> Sequence[Value]:
    return value if isinstance(value, list | tuple) else ()


def _has(sensor: Component, begin: str) -> bool:
    return any(state.startswith(begin) for state in sensor.states)


def _ros_name(text: str) -> str:
    """Return a text as a valid name of a ROS node."""
    name = _STRANGE.sub("_", text).strip("_")[:_LONGEST] or "robot"
    return f"_{name}" if name[0].isdigit() else name


def _with_unique_names(controllers: Iterable[Controller]) -> Iterator[Controller]:
    """Yield the controllers with unique names."""
    taken = {"controller_manager"}
    for each in controllers:
        name, number = each.name, 2
        while name in taken:
            name, number = f"{each.name}_{number}", number + 1
        taken.add(name)
        yield each if name == each.name else Controller(name, each.type, each.parameters)


_ALONG = 0.999
"""The cosine above which an axle lies across the way."""
_SAME_GROUND = 0.2
"""How far apart in height two wheels on the same ground may end, as a share of the radius."""


@dataclass(frozen=True, slots=True)
class Drive:
    """The joints of the wheels on both sides, the distance between the sides, and the radius of a wheel, in m."""

    left: tuple[str, ...]
    right: tuple[str, ...]
    separation: float
    radius: float


def differential_drive(model: Model, joints: Sequence[str], others: Sequence[str], format_: Format) -> Drive:
    """Measure the differential drive of joints with commanded velocities: wheels that move the root along its x.

    `others` are the other commanded joints, which must not steer a wheel.

    Raises:
        NotMeasuredError: the joints are no differential drive; the message has the reason.
    """
    wheels = {name: wheel(model, name, format_) for name in joints}
    for name, each in wheels.items():
        if each.axle[1] < _ALONG:
            raise NotMeasuredError(f"the axle of joint {name!r} does not point to the left, along y")
        turning = _turning_above(model, name, others)
        if turning:
            raise NotMeasuredError(f"joint {turning!r} moves the wheel of joint {name!r}")
    radius = radius_of(wheels.values())
    # Cars are told apart by a wheel on the same ground that turns with a commanded joint. A
    # caster's swivel is not commanded, and an arm's joints reach no ground.
    steered = _steered_wheel(model, min(each.center[2] for each in wheels.values()) - radius, others, format_)
    if steered:
        raise NotMeasuredError(f"the wheel of joint {steered!r} is steered")
    left, right = _sides(wheels)
    separation = separation_of([wheels[name] for name in left], [wheels[name] for name in right])
    return Drive(left, right, separation, radius)


def _sides(wheels: Mapping[str, Wheel]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    across = [each.center[1] for each in wheels.values()]
    middle = (min(across) + max(across)) / 2
    left = tuple(name for name, each in wheels.items() if each.center[1] > middle)
    right = tuple(name for name in wheels if name not in left)
    if len(left) != len(right):
        raise NotMeasuredError(f"there are {len(left)} wheels on the left and {len(right)} on the right")
    return left, right


def _steered_wheel(model: Model, ground: float, commanded: Sequence[str], format_: Format) -> str | None:
    """Return the joint of a wheel on the ground that a commanded joint steers."""
    return next(
        (
            joint.name
            for joint in model.joints
            if joint.type == "continuous"
            and _turning_above(model, joint.name, commanded) in commanded
            and _stands_on(model, joint.name, ground, format_)
        ),
        None,
    )


def _stands_on(model: Model, joint: str, ground: float, format_: Format) -> bool:
    try:
        found = wheel(model, joint, format_)
    except NotMeasuredError:
        return False
    return found.radius is not None and abs(found.center[2] - found.radius - ground) < _SAME_GROUND * found.radius


def _turning_above(model: Model, name: str, commanded: Sequence[str]) -> str | None:
    """Return the nearest movable joint above a joint, except for suspensions, which are not commanded."""
    by_child = {joint.child: joint for joint in model.joints}
    at, seen = next(joint for joint in model.joints if joint.name == name).parent, set[str | None]()
    while at in by_child and at not in seen:
        seen.add(at)
        joint = by_child[at]
        if joint.type != "fixed" and (joint.type != "prismatic" or joint.name in commanded):
            return joint.name
        at = joint.parent
    return None
