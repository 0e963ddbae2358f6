"""Rigid bodies."""

from twinform.ir.inertial import Inertial
from twinform.ir.light import Light
from twinform.ir.node import Node
from twinform.ir.pose import Pose
from twinform.ir.sensor import Sensor
from twinform.ir.visual import Collision, Visual


class Link(Node):
    """A rigid body; `pose` puts its frame in the model frame, or in the frame that the pose names.

    A link of URDF that is the child of a joint has a pose of zero relative to that joint.
    """

    name: str
    pose: Pose | None = None
    gravity: bool | None = None
    enable_wind: bool | None = None
    self_collide: bool | None = None
    kinematic: bool | None = None
    inertial: Inertial | None = None
    visuals: tuple[Visual, ...] = ()
    collisions: tuple[Collision, ...] = ()
    sensors: tuple[Sensor, ...] = ()
    lights: tuple[Light, ...] = ()
