"""What a link shows and what it touches with."""

from twinform.ir.geometry import Geometry
from twinform.ir.material import Material
from twinform.ir.node import Node
from twinform.ir.plugin import Plugin
from twinform.ir.pose import Pose
from twinform.ir.surface import Surface


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
