"""Visuals and collisions of a link, their materials and contact surfaces."""

from twinform.ir.geometry import Geometry
from twinform.ir.node import Color, Node, Vector3
from twinform.ir.pose import Pose
from twinform.ir.record import record
from twinform.ir.sensor import Plugin


@record
class Script(Node):
    """A material of Gazebo Classic by name.

    Attributes:
        uris: of the scripts that define it.
        name: of the material in them.
    """

    uris: tuple[str, ...] = ()
    name: str | None = None


@record
class Material(Node):
    """The colors and textures of a visual. Colors are red, green, blue and perhaps alpha, each from 0 to 1.

    Attributes:
        name: of URDF, where visuals share a material.
        color: of URDF; each part from 0 to 1.
        texture: the URI of an image, of URDF.
        script: a material of Gazebo Classic, of SDF.
        ambient: the color in the light from everywhere, of SDF; each part from 0 to 1.
        diffuse: the color in the light from somewhere, of SDF; each part from 0 to 1.
        specular: the color of reflections, of SDF; each part from 0 to 1.
        emissive: the color that it has without light, of SDF; each part from 0 to 1.
        albedo_map: the URI of an image, of SDF's metal-rough materials.
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


@record
class Surface(Node):
    """Contact parameters of a collision, for the ODE solver.

    They are the part of SDF's `surface` that the `<gazebo>` tags of URDF have; the rest stays in `opaque`.

    Attributes:
        mu: Coulomb friction along `fdir1`; without a unit.
        mu2: Coulomb friction across `fdir1`; without a unit.
        fdir1: a direction in the collision frame; without a unit.
        slip1: force dependent slip along `fdir1`; m/(N s).
        slip2: force dependent slip across `fdir1`; m/(N s).
        kp: stiffness of the contact; N/m.
        kd: damping of the contact; N s/m.
        max_vel: the fastest correction of a penetration; m/s.
        min_depth: the penetration that is left alone; m.
        restitution_coefficient: how much of the speed a bounce keeps, from 0 to 1.
        threshold: the speed above which it bounces; m/s.
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


@record
class Visual(Node):
    """A shape that is seen.

    Attributes:
        name: unique in its link.
        pose: of the shape, in the link frame unless it names another.
        geometry: the shape.
        material: how it looks.
        plugins: code that a simulator loads with it.
    """

    name: str | None = None
    pose: Pose | None = None
    geometry: Geometry | None = None
    material: Material | None = None
    plugins: tuple[Plugin, ...] = ()


@record
class Collision(Node):
    """A shape that touches.

    Attributes:
        name: unique in its link.
        pose: of the shape, in the link frame unless it names another.
        geometry: the shape.
        surface: what happens where it touches.
        max_contacts: how many points of contact a simulator keeps.
        laser_retro: the intensity that a lidar gets back; without a unit.
    """

    name: str | None = None
    pose: Pose | None = None
    geometry: Geometry | None = None
    surface: Surface | None = None
    max_contacts: int | None = None
    laser_retro: float | None = None
