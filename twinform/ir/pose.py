"""Poses, in the notation in which they were written, and named frames."""

from twinform.ir.node import Node, Quaternion, Vector3


class Pose(Node):
    """Where a frame is, in another frame.

    Translation `xyz` in meters; rotation either `rpy` (fixed-axis roll, pitch, yaw: R = Rz(yaw) Ry(pitch) Rx(roll); in
    radians, or in degrees where `degrees` is true) or `quat_xyzw`. What is `None` was not written and means zero.
    `relative_to` names the frame that the pose is expressed in; where it is `None`, it is that of the holder.
    `rotation_format` is SDF's attribute, kept because it may be written for rpy too.
    """

    xyz: Vector3 | None = None
    rpy: Vector3 | None = None
    quat_xyzw: Quaternion | None = None
    degrees: bool | None = None
    rotation_format: str | None = None
    relative_to: str | None = None


class Frame(Node):
    """A frame that moves with what it is attached to: a link, joint, frame or model; the model itself where not given.

    `pose` is in the frame that it names, or else in the one that this is attached to.
    """

    name: str
    attached_to: str | None = None
    pose: Pose | None = None
