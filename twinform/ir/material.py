"""How a visual looks."""

from twinform.ir.node import Color, Node


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
