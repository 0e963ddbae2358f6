"""Worlds."""

from twinform.ir.joint import Joint
from twinform.ir.light import Light
from twinform.ir.model import Include, Model
from twinform.ir.node import Node, Vector3
from twinform.ir.plugin import Plugin
from twinform.ir.pose import Frame


class World(Node):
    """Models, lights and frames in one frame; `gravity` in m/s^2. Physics, scene and the like stay in `opaque`."""

    name: str
    gravity: Vector3 | None = None
    models: tuple[Model, ...] = ()
    includes: tuple[Include, ...] = ()
    lights: tuple[Light, ...] = ()
    frames: tuple[Frame, ...] = ()
    joints: tuple[Joint, ...] = ()
    plugins: tuple[Plugin, ...] = ()
