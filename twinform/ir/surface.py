"""How a collision touches."""

from twinform.ir.node import Node, Vector3


class Surface(Node):
    """Contact parameters of a collision: the part of SDF's `surface` that the `<gazebo>` tags of URDF can say.

    `mu`, `mu2`: Coulomb friction along and across `fdir1` (a direction in the collision frame); `slip1`, `slip2`: force
    dependent slip (m/(N s)); `kp`, `kd`: stiffness (N/m) and damping (N s/m) of the contact; `max_vel`: the fastest
    correction (m/s); `min_depth`: the penetration that is left alone (m). All are those of the ODE solver.
    """

    mu: float | None = None
    mu2: float | None = None
    fdir1: Vector3 | None = None
    slip1: float | None = None
    slip2: float | None = None
    kp: float | None = None
    kd: float | None = None
    max_vel: float | None = None
    min_depth: float | None = None
    restitution_coefficient: float | None = None
    threshold: float | None = None
