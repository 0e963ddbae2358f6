"""Sensors."""

from twinform.ir.node import Node
from twinform.ir.plugin import Plugin
from twinform.ir.pose import Pose


class Sensor(Node):
    """A sensor on a link or joint; `pose` is in the frame of its holder.

    The parameters of its type (`<camera>`, `<imu>`, ...) stay in `opaque`, checked by the schema.
    """

    name: str | None = None
    type: str | None = None
    pose: Pose | None = None
    always_on: bool | None = None
    update_rate: float | None = None
    visualize: bool | None = None
    topic: str | None = None
    frame_id: str | None = None
    enable_metrics: bool | None = None
    plugins: tuple[Plugin, ...] = ()
