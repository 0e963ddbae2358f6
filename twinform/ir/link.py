"""Links: rigid bodies, and their mass and inertia."""

from twinform.ir.light import Light
from twinform.ir.node import Node
from twinform.ir.pose import Pose
from twinform.ir.sensor import Sensor
from twinform.ir.visual import Collision, Visual


class Inertia(Node):
    """The rotational inertia about the center of mass, in the axes of the inertial frame, kg m^2."""

    ixx: float | None = None
    ixy: float | None = None
    ixz: float | None = None
    iyy: float | None = None
    iyz: float | None = None
    izz: float | None = None


class Inertial(Node):
    """The mass (kg) of a link; `pose` puts the center of mass and the axes of `inertia` in the link frame."""

    pose: Pose | None = None
    mass: float | None = None
    inertia: Inertia | None = None
    auto: bool | None = None


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
