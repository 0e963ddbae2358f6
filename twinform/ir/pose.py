"""Poses, in the notation in which they were written, and named frames."""

from twinform.ir.node import Node, Quaternion, Vector3
from twinform.ir.record import record


@record
class Pose(Node):
    """Where a frame is, in another frame.

    What is `None` was not written and means zero.

    Attributes:
        xyz: the translation; m.
        rpy: the rotation as fixed-axis roll, pitch, yaw, R = Rz(yaw) Ry(pitch) Rx(roll); rad, or degrees if `degrees`.
        quat_xyzw: the rotation as a quaternion x, y, z, w, in place of `rpy`; without a unit.
        degrees: whether `rpy` is in degrees.
        rotation_format: the attribute of SDF, `euler_rpy` or `quat_xyzw`, kept because it may be written for `rpy` too.
        relative_to: the frame that the pose is expressed in; `None` for that of the holder.
    """

    xyz: Vector3 | None = None
    rpy: Vector3 | None = None
    quat_xyzw: Quaternion | None = None
    degrees: bool | None = None
    rotation_format: str | None = None
    relative_to: str | None = None


@record
class Frame(Node):
    """A frame that moves with what it is attached to.

    Attributes:
        name: unique in its model or world.
        attached_to: a link, joint, frame or model; `None` for the model or world that it is in.
        pose: of the frame, in the one that it names, or else in the one that this is attached to.
    """

    name: str
    attached_to: str | None = None
    pose: Pose | None = None
