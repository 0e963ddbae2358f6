"""The places in companion files at which names of a robot's parts stand, and the names at these places.

A file is a tree of keys, or of elements and `@attributes`, and each of its values a leaf with a path. A row of the
table has the end of a path: `*` is any one step, `**` any number of them, and `<joint>` a step that is itself a name.
Lists are no steps: each item has the path of the list. After `beside` stands a key that the value's mapping has too.
"""

import re
from bisect import bisect_left
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import cache
from typing import Generic, Literal, NamedTuple, TypeVar, cast

from twinform.dataclass import dataclass

NameKind = Literal["joint", "driven joint", "link", "frame", "group", "sensor", "interface", "controller"]
"""What a name means. A `driven joint` is one of `<ros2_control>`; an `interface` is `joint/interface`; a `frame` may be
one that is not of the robot, and a `link` may not."""
PART_OF: Mapping[NameKind, Literal["joint", "link"]] = {
    "joint": "joint", "driven joint": "joint", "interface": "joint", "link": "link", "frame": "link",
}  # fmt: skip
"""The part of a robot that a name is of, by its kind."""

_TABLE = """
# SRDF
group/link/@name                                        link
group/joint/@name                                       joint
group/passive_joint/@name                               joint
group/chain/@base_link                                  link
group/chain/@tip_link                                   link
group/group/@name                                       group
group_state/@group                                      group
group_state/joint/@name                                 joint
end_effector/@parent_link                               link
end_effector/@group                                     group
end_effector/@parent_group                              group
virtual_joint/@child_link                               link
passive_joint/@name                                     joint
disable_collisions/@link1                               link
disable_collisions/@link2                               link
enable_collisions/@link1                                link
enable_collisions/@link2                                link
disable_default_collisions/@link                        link
link_sphere_approximation/@link                         link
joint_property/@joint_name                              joint

# controllers of ros2_control
left_wheel_names                                        driven joint
right_wheel_names                                       driven joint
wheel_names                                             driven joint
front_wheels_names                                      driven joint
rear_wheels_names                                       driven joint
front_wheels_state_names                                driven joint
rear_wheels_state_names                                 driven joint
traction_joints_names                                   driven joint
steering_joints_names                                   driven joint
traction_joints_state_names                             driven joint
steering_joints_state_names                             driven joint
traction_joint_name                                     driven joint
steering_joint_name                                     driven joint
front_left_wheel_command_joint_name                     driven joint
front_right_wheel_command_joint_name                    driven joint
rear_left_wheel_command_joint_name                      driven joint
rear_right_wheel_command_joint_name                     driven joint
front_left_wheel_state_joint_name                       driven joint
front_right_wheel_state_joint_name                      driven joint
rear_left_wheel_state_joint_name                        driven joint
rear_right_wheel_state_joint_name                       driven joint
dof_names                                               driven joint
ros__parameters/joints                                  driven joint
ros__parameters/joint                                   driven joint
ros__parameters/joint_name                              driven joint
ros__parameters/joint_names                             joint
ros__parameters/starting_point_limits/<joint>           joint
ros__parameters/gains/<joint>/*                         joint
ros__parameters/constraints/<joint>/*                   joint
ros__parameters/extra_joints                            frame
sensor_name                                             sensor
max_effort_interface                                    interface
max_velocity_interface                                  interface
ros__parameters/frame_id                                frame
odometry/child_frame_id                                 link
ros__parameters/**/child_frame_id                       frame
ros__parameters/kinematics/base                         link
ros__parameters/kinematics/tip                          link
ros__parameters/ft_sensor/frame/id                      link
ros__parameters/control/frame/id                        link
robot_base_link                                         link
end_effector_link                                       link
ft_sensor_ref_link                                      link

# controllers of ROS 1 and of MoveIt
joints beside type                                      joint
joint beside type                                       joint
left_wheel beside type                                  joint
right_wheel beside type                                 joint
hardware_interface/joints                               joint
controller_joint_names                                  joint
pid_gains/<joint>/*                                     joint
gains/<joint>/p                                         joint
constraints/<joint>/goal                                joint
constraints/<joint>/trajectory                          joint
moveit_simple_controller_manager/controller_names       controller
controller_names                                        controller

# MoveIt
joint_limits/<joint>/has_velocity_limits                joint
joint_limits/<joint>/has_acceleration_limits            joint
joint_limits/<joint>/has_position_limits                joint
joint_limits/<joint>/has_jerk_limits                    joint
joint_limits/<joint>/max_velocity                       joint
joint_limits/<joint>/max_acceleration                   joint
joint_limits/<joint>/max_position                       joint
<group>/kinematics_solver                               group
<group>/planner_configs                                 group
<group>/default_planner_config                          group
move_group_name                                         group
animate_endeffector_segment                             link
planning_frame                                          link
ee_frame_name                                           link
robot_link_command_frame                                link

# Nav2, robot_localization, SLAM
robot_base_frame                                        link
base_frame_id                                           link
base_link_frame                                         link
ros__parameters/**/base_frame                           link
ros__parameters/**/sensor_frame                         link
base_link_frame_output                                  frame
ros__parameters/**/global_frame                         frame
ros__parameters/**/global_frame_id                      frame
ros__parameters/**/odom_frame                           frame
ros__parameters/**/odom_frame_id                        frame
ros__parameters/**/map_frame                            frame
ros__parameters/**/world_frame                          frame
ros__parameters/**/target_frame                         frame
ros__parameters/**/target_frames                        frame
ros__parameters/**/output_frame                         frame
ros__parameters/**/box_frame                            frame
ros__parameters/**/camera_frame                         frame
ros__parameters/**/laser_frame                          frame
ros__parameters/**/imu_frame                            frame
"""

Place = TypeVar("Place")
"""Where something stands: a span of a text, or a location."""


@dataclass(frozen=True, slots=True)
class Step(Generic[Place]):
    """A key or value of a file, and where it stands."""

    text: str
    place: Place


@dataclass(frozen=True, slots=True)
class Leaf(Generic[Place]):
    """A value of a file, the steps that lead to it, and the keys of the mapping that has it."""

    path: tuple[Step[Place], ...]
    value: Step[Place]
    beside: Collection[str] = ()

    def ends_in(self, *steps: str) -> bool:
        """Whether the last steps to the value are these; `*` is any."""
        own = [each.text for each in self.path[-len(steps) :]]
        return len(own) == len(steps) and all(step in {"*", text} for step, text in zip(steps, own, strict=True))


@dataclass(frozen=True, slots=True)
class Mention(Generic[Place]):
    """A name in a companion file, what it means, where it stands, and the leaf by which it was found."""

    kind: NameKind
    text: str
    place: Place
    leaf: Leaf[Place]

    @property
    def name(self) -> str:
        """The name of the part: of an interface `joint/velocity`, and of a joint of another controller `pid/joint`."""
        match self.kind:
            case "interface":
                return self.text.rpartition("/")[0]
            case "driven joint":
                return self.text.rpartition("/")[2]
            case _:
                return self.text


class _Row(NamedTuple):
    """The end of a path, its steps in reverse; what the name there means; and a key that has to be beside it."""

    steps: tuple[str, ...]
    kind: NameKind
    beside: str

    def find(self, leaf: Leaf[Place]) -> Step[Place] | None:
        """Return the step or value of a leaf that is a name, if its path has this end."""
        at, found, is_open = len(leaf.path), leaf.value, False
        for step in self.steps:
            at -= 1
            while is_open and at > 0 and leaf.path[at].text != step:
                at -= 1
            if step == "**":
                at, is_open = at + 1, True
                continue
            if at < 0 or not (step[0] in "*<" or leaf.path[at].text == step):
                return None
            found, is_open = leaf.path[at] if step[0] == "<" else found, False
        return found if not self.beside or self.beside in leaf.beside else None


@cache
def _rows() -> dict[str, list[_Row]]:
    """The rows of the table by their last step; those that any step ends have `*`."""
    found: dict[str, list[_Row]] = defaultdict(list)
    for line in _TABLE.splitlines():
        if line and line[0] != "#":
            path, _, kind = line.rpartition("  ")
            path, _, beside = path.strip().partition(" beside ")
            steps = tuple(reversed(path.split("/")))
            row = _Row(steps, cast("NameKind", kind), beside)
            found[steps[0] if steps[0][0] not in "*<" else "*"].append(row)
    return found


@cache
def paths_of_srdf() -> dict[tuple[str, ...], NameKind]:
    """Return the paths of SRDF at which names stand, from below the root on, each with what the name there means."""
    rows = (row for found in _rows().values() for row in found)
    return {tuple(reversed(row.steps)): row.kind for row in rows if row.steps[0].startswith("@")}


@cache
def telling_keys() -> tuple[str, ...]:
    """Return the keys of which each file with a name has one at least."""
    ends = {row.steps[0]: row for rows in _rows().values() for row in rows if row.steps[0][0] not in "*<@"}
    inner = {step for row in _rows()["*"] for step in row.steps if step[0] not in "*<"}
    return tuple(sorted({*ends, *inner}))


def mentions(leaves: Iterable[Leaf[Place]]) -> Iterator[Mention[Place]]:
    """Yield the names in a file, each place once."""
    seen: set[tuple[NameKind, Place]] = set()
    rows = _rows()
    for leaf in leaves:
        if not leaf.path:
            continue
        for row in (*rows.get(leaf.path[-1].text, ()), *rows["*"]):
            step = row.find(leaf)
            if step is not None and step.text and (row.kind, step.place) not in seen:
                seen.add((row.kind, step.place))
                yield Mention(row.kind, step.text, step.place, leaf)
                break


_EXPRESSION = re.compile(r"\$\([^)]*\)|\$\{[^}]*\}|<\w+>")


def is_made(name: str) -> bool:
    """Whether a name is made by an expression or a template, such as `$(var prefix)joint_1` or `<namespace>/imu`."""
    return _EXPRESSION.search(name) is not None


def without_expressions(name: str) -> str:
    """Return what a name is where all of its expressions are empty, as prefixes and namespaces mostly are."""
    return _EXPRESSION.sub("", name).removeprefix("/")


class NameSet:
    """Names of parts; one that is made by expressions, whose values are not known, is in it if it may become one."""

    def __init__(self, names: Iterable[str]) -> None:
        self._names = frozenset(names)
        self._reversed: list[str] | None = None

    def __contains__(self, name: str) -> bool:
        return self._has_end(without_expressions(name)) if is_made(name) else name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def _has_end(self, end: str) -> bool:
        if self._reversed is None:
            self._reversed = sorted(each[::-1] for each in self._names)
        at = bisect_left(self._reversed, end[::-1])
        return at < len(self._reversed) and self._reversed[at].startswith(end[::-1])
