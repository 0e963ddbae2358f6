"""Visuals and collisions of a link, their materials and contact surfaces."""

from twinform.ir.geometry import Geometry
from twinform.ir.node import Color, Node, Vector3
from twinform.ir.plugin import Plugin
from twinform.ir.pose import Pose


class Script(Node):
    """A material of Gazebo Classic by name, with the URIs of the scripts that define it."""

    uris: tuple[str, ...] = ()
    name: str | None = None


class Material(Node):
    """The colors and textures of a visual.

    `name`, `color` and `texture` (an image's URI) are URDF's; the light model's four colors, the `script` and the
    metal-rough `albedo_map` (an image's URI) are SDF's.
    """

    name: str | None = None
    color: Color | None = None
    texture: str | None = None
    script: Script | None = None
    ambient: Color | None = None
    diffuse: Color | None = None
    specular: Color | None = None
    emissive: Color | None = None
    albedo_map: str | None = None


class Surface(Node):
    """Contact parameters of a collision: the part of SDF's `surface` that the `<gazebo>` tags of URDF have.

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


class Visual(Node):
    """A shape that is seen; `pose` is in the link frame."""

    name: str | None = None
    pose: Pose | None = None
    geometry: Geometry | None = None
    material: Material | None = None
    plugins: tuple[Plugin, ...] = ()


class Collision(Node):
    """A shape that touches; `pose` is in the link frame."""

    name: str | None = None
    pose: Pose | None = None
    geometry: Geometry | None = None
    surface: Surface | None = None
    max_contacts: int | None = None
    laser_retro: float | None = None
