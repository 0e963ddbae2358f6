"""Mass and its distribution."""

from twinform.ir.node import Node
from twinform.ir.pose import Pose


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
