"""Worlds."""

from twinform.ir.joint import Joint
from twinform.ir.light import Light
from twinform.ir.model import Include, Model
from twinform.ir.node import Node, Vector3
from twinform.ir.plugin import Plugin
from twinform.ir.pose import Frame
from twinform.ir.record import record


@record
class World(Node):
    """Models, lights and frames in one frame. Physics, scene and the like stay in `opaque`.

    Attributes:
        name: unique in its file.
        gravity: the acceleration in the frame of the world; m/s^2.
        models: in their order.
        includes: models of other files.
        lights: in their order.
        frames: the named frames.
        joints: between models, or of one to the world.
        plugins: the systems that a simulator runs.
    """

    name: str
    gravity: Vector3 | None = None
    models: tuple[Model, ...] = ()
    includes: tuple[Include, ...] = ()
    lights: tuple[Light, ...] = ()
    frames: tuple[Frame, ...] = ()
    joints: tuple[Joint, ...] = ()
    plugins: tuple[Plugin, ...] = ()
