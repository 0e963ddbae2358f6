"""Joints: axes, limits, dynamics and mimic."""

from typing import Literal

from twinform.ir.node import Node, Vector3
from twinform.ir.pose import Pose
from twinform.ir.record import record
from twinform.ir.sensor import Sensor

JointType = Literal[
    "fixed", "revolute", "continuous", "prismatic", "floating", "planar", "spherical",
    "ball", "universal", "revolute2", "screw", "gearbox", "piston",
]  # fmt: skip


@record
class Limit(Node):
    """Limits of one degree of freedom, of which lengths are meant along an axis and angles about one.

    Attributes:
        lower: the least position; rad or m.
        upper: the greatest position; rad or m.
        effort: the greatest torque or force; N m or N.
        velocity: the greatest speed; rad/s or m/s.
        acceleration: the greatest; rad/s^2 or m/s^2.
        deceleration: the greatest when it slows down; rad/s^2 or m/s^2.
        jerk: the greatest; rad/s^3 or m/s^3.
        stiffness: of the stops at both ends; N m/rad or N/m.
        dissipation: of the stops at both ends; N m s/rad or N s/m.
    """

    lower: float | None = None
    upper: float | None = None
    effort: float | None = None
    velocity: float | None = None
    acceleration: float | None = None
    deceleration: float | None = None
    jerk: float | None = None
    stiffness: float | None = None
    dissipation: float | None = None


@record
class Dynamics(Node):
    """Passive forces along one degree of freedom.

    Attributes:
        damping: against the velocity; N m s/rad or N s/m.
        friction: against the motion; N m or N.
        spring_reference: the position that the spring pulls to; rad or m.
        spring_stiffness: of the spring; N m/rad or N/m.
    """

    damping: float | None = None
    friction: float | None = None
    spring_reference: float | None = None
    spring_stiffness: float | None = None


@record
class Mimic(Node):
    """A position that follows another joint: multiplier * (leader - reference) + offset.

    Attributes:
        joint: the name of the leader.
        axis: which axis of the leader, `axis` or `axis2`; of SDF.
        multiplier: the follower's way for one unit of the leader's.
        offset: the position of the follower where the leader is at `reference`; rad or m.
        reference: a position of the leader; rad or m; of SDF.
    """

    joint: str | None = None
    axis: str | None = None
    multiplier: float | None = None
    offset: float | None = None
    reference: float | None = None


@record
class Axis(Node):
    """One degree of freedom, along or about a direction.

    Attributes:
        xyz: the direction, in the joint frame or in the one that `expressed_in` names; without a unit, of any length.
        expressed_in: the frame of `xyz`; `None` for the joint frame.
        use_parent_model_frame: the same question as SDF before 1.7 asked it: true means the model frame.
        limit: how far, how fast and how hard.
        dynamics: damping, friction and a spring.
        mimic: the joint that it follows.
    """

    xyz: Vector3 | None = None
    expressed_in: str | None = None
    use_parent_model_frame: bool | None = None
    limit: Limit | None = None
    dynamics: Dynamics | None = None
    mimic: Mimic | None = None


@record
class Joint(Node):
    """What connects two frames and lets them move.

    Attributes:
        name: unique in its model.
        type: how they move; URDF and SDF have types that the other lacks.
        parent: the frame that it stands on: in URDF a link, in SDF a link, frame, model or `world`.
        child: the frame that it moves, likewise.
        pose: of the joint frame: in the parent link's frame in URDF, in the child's in SDF unless it names another.
        axis: the first degree of freedom.
        axis2: the second one, of `universal` and `revolute2`.
        gearbox_ratio: of `gearbox`: turns of the one side for one of the other; without a unit.
        gearbox_reference_body: of `gearbox`: the link that both angles are taken from.
        thread_pitch: of `screw`, as older files write it: rad/m, left-handed.
        screw_thread_pitch: of `screw`: m per revolution, right-handed.
        sensors: on the joint, such as `force_torque`.
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
