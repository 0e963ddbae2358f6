"""Lights."""

from twinform.ir.node import Color, Node, Vector3
from twinform.ir.pose import Pose


class Light(Node):
    """A light of a world or on a link: `point`, `directional` or `spot`; `pose` is in the frame of its holder."""

    name: str | None = None
    type: str | None = None
    pose: Pose | None = None
    cast_shadows: bool | None = None
    intensity: float | None = None
    diffuse: Color | None = None
    specular: Color | None = None
    direction: Vector3 | None = None
