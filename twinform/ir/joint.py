"""Joints: axes, limits, dynamics and mimic."""

from typing import Literal

from twinform.ir.node import Node, Vector3
from twinform.ir.pose import Pose
from twinform.ir.sensor import Sensor

JointType = Literal[
    "fixed", "revolute", "continuous", "prismatic", "floating", "planar", "spherical",
    "ball", "universal", "revolute2", "screw", "gearbox", "piston",
]  # fmt: skip


class Limit(Node):
    """Limits of one degree of freedom: rad or m, N m or N, and their derivatives in time."""

    lower: float | None = None
    upper: float | None = None
    effort: float | None = None
    velocity: float | None = None
    acceleration: float | None = None
    deceleration: float | None = None
    jerk: float | None = None
    stiffness: float | None = None
    dissipation: float | None = None


class Dynamics(Node):
    """Passive forces along one degree of freedom.

    `damping` in N m s/rad or N s/m, `friction` in N m or N; the spring pulls towards `spring_reference` (rad or m) with
    `spring_stiffness` (N m/rad or N/m).
    """

    damping: float | None = None
    friction: float | None = None
    spring_reference: float | None = None
    spring_stiffness: float | None = None


class Mimic(Node):
    """Position follows another joint: multiplier * (leader - reference) + offset, in rad or m."""

    joint: str | None = None
    axis: str | None = None
    multiplier: float | None = None
    offset: float | None = None
    reference: float | None = None


class Axis(Node):
    """One degree of freedom along or about `xyz`, in the joint frame or in the one that `expressed_in` names.

    `use_parent_model_frame` is the same question as SDF before 1.7 asked it: true means the model frame.
    """

    xyz: Vector3 | None = None
    expressed_in: str | None = None
    use_parent_model_frame: bool | None = None
    limit: Limit | None = None
    dynamics: Dynamics | None = None
    mimic: Mimic | None = None


class Joint(Node):
    """Connects the frames `parent` and `child`.

    `pose` is in the child's frame unless it names another; a joint of URDF names its parent link.
    `screw_thread_pitch` is in m per revolution, right-handed; the older `thread_pitch` in rad/m, left-handed.
    """

    name: str
    type: JointType
    parent: str | None = None
    child: str | None = None
    pose: Pose | None = None
    axis: Axis | None = None
    axis2: Axis | None = None
    gearbox_ratio: float | None = None
    gearbox_reference_body: str | None = None
    thread_pitch: float | None = None
    screw_thread_pitch: float | None = None
    sensors: tuple[Sensor, ...] = ()
