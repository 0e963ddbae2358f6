"""Sensors, lights, and plugins, which a simulator loads with a model."""

from collections.abc import Mapping

from twinform.ir.element import Element
from twinform.ir.node import Color, Node, Vector3
from twinform.ir.pose import Pose
from twinform.ir.record import record


@record
class Plugin(Node):
    """Code that a simulator loads, with parameters that only the plugin understands.

    Attributes:
        name: in Gazebo the class in the library; in Gazebo Classic any name.
        filename: the shared library.
        text: the text in it, where it is not made of elements.
        content: its parameters, in their order.
    """

    name: str | None = None
    filename: str | None = None
    text: str | None = None
    content: tuple[Element, ...] = ()


_CAMERAS = (
    "boundingbox", "boundingbox_camera", "camera", "depth", "depth_camera", "multicamera", "rgbd", "rgbd_camera",
    "segmentation", "segmentation_camera", "stereocamera", "thermal", "thermal_camera", "wide_angle_camera",
    "wideanglecamera",
)  # fmt: skip
_BY_THEIR_TYPE = (
    "air_pressure", "air_speed", "altimeter", "contact", "force_torque", "imu", "logical_camera", "magnetometer",
    "rfid", "rfidtag", "sonar",
)  # fmt: skip
SENSOR_ELEMENTS: Mapping[str, frozenset[str]] = {
    **dict.fromkeys(_CAMERAS, frozenset({"camera"})),
    **dict.fromkeys(("gpu_lidar", "gpu_ray", "lidar", "ray"), frozenset({"lidar", "ray"})),
    **dict.fromkeys(("gps", "navsat"), frozenset({"gps", "navsat"})),
    **dict.fromkeys(("wireless_receiver", "wireless_transmitter"), frozenset({"transceiver"})),
    **{type_: frozenset({type_}) for type_ in _BY_THEIR_TYPE},
}
"""Which element holds the parameters of each type of sensor; other types may have any."""
RENAMED_ELEMENTS: Mapping[str, str] = {"ray": "lidar", "gps": "navsat"}
"""Of elements with the parameters of a sensor that have two names, the new one by the old one."""


@record
class Sensor(Node):
    """A sensor on a link or joint.

    The parameters of its type (`<camera>`, `<imu>`, ...) stay in `opaque`, checked by the schema.

    Attributes:
        name: unique in its holder.
        type: such as `imu`, `camera` or `gpu_lidar`.
        pose: of the sensor, in the frame of its holder unless it names another.
        always_on: whether it measures although nobody listens.
        update_rate: Hz; 0 for every step.
        visualize: whether a simulator shows what it sees.
        topic: where it publishes.
        frame_id: the frame that its messages name.
        enable_metrics: whether it publishes how fast it is.
        plugins: code that a simulator loads with it.
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
