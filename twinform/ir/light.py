"""Lights."""

from twinform.ir.node import Color, Node, Vector3
from twinform.ir.pose import Pose
from twinform.ir.record import record


@record
class Light(Node):
    """A light of a world or on a link.

    Attributes:
        name: unique in its holder.
        type: `point`, `directional` or `spot`.
        pose: of the light, in the frame of its holder unless it names another.
        cast_shadows: whether it does.
        intensity: a factor of both colors; without a unit.
        diffuse: the color of what it lights; red, green, blue and perhaps alpha, each from 0 to 1.
        specular: the color of its reflections; red, green, blue and perhaps alpha, each from 0 to 1.
        direction: where it shines, in the frame of the light; without a unit.
    """

    name: str | None = None
    type: str | None = None
    pose: Pose | None = None
    cast_shadows: bool | None = None
    intensity: float | None = None
    diffuse: Color | None = None
    specular: Color | None = None
    direction: Vector3 | None = None
