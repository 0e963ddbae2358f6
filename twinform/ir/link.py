"""Links: rigid bodies, and their mass and inertia."""

from twinform.ir.node import Node
from twinform.ir.pose import Pose
from twinform.ir.record import record
from twinform.ir.sensor import Light, Sensor
from twinform.ir.visual import Collision, Visual


@record
class Inertia(Node):
    """The rotational inertia about the center of mass, in the axes of the inertial frame.

    Attributes:
        ixx: the moment about x; kg m^2.
        ixy: the product of x and y, with the sign that it has in the matrix; kg m^2.
        ixz: the product of x and z, likewise; kg m^2.
        iyy: the moment about y; kg m^2.
        iyz: the product of y and z, likewise; kg m^2.
        izz: the moment about z; kg m^2.
    """

    ixx: float | None = None
    ixy: float | None = None
    ixz: float | None = None
    iyy: float | None = None
    iyz: float | None = None
    izz: float | None = None


@record
class Inertial(Node):
    """The mass of a link and how it is spread.

    Attributes:
        pose: of the inertial frame in the link frame: the center of mass, and the axes of `inertia`.
        mass: kg.
        inertia: about the center of mass.
        auto: whether Gazebo computes all of it from the collisions; of SDF.
    """

    pose: Pose | None = None
    mass: float | None = None
    inertia: Inertia | None = None
    auto: bool | None = None


@record
class Link(Node):
    """A rigid body.

    Attributes:
        name: unique in its model.
        pose: of the link frame, in the model frame unless it names another. A link of URDF that is the child of a joint
            has a pose of zero relative to that joint.
        gravity: whether gravity acts on it.
        enable_wind: whether wind acts on it.
        self_collide: whether it collides with other links of its model.
        kinematic: whether only commands move it, not forces.
        inertial: mass, center of mass and inertia; `None` where nothing was written.
        visuals: the shapes that are seen.
        collisions: the shapes that touch.
        sensors: on the link; in URDF those of its `<gazebo>` elements stay in the model's `extensions`.
        lights: on the link.
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
