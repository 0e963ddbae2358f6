"""What the sources of gz-sensors and gz-sim say about sensors: suffixes of default topics, topics and messages."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from reports.systems.cpp import source_text

_FILES = {
    "camera": ("CameraSensor",),
    "depth_camera": ("DepthCameraSensor",),
    "rgbd_camera": ("RgbdCameraSensor",),
    "thermal_camera": ("ThermalCameraSensor",),
    "segmentation_camera": ("SegmentationCameraSensor",),
    "boundingbox_camera": ("BoundingBoxCameraSensor",),
    "wideanglecamera": ("WideAngleCameraSensor",),
    "gpu_lidar": ("GpuLidarSensor", "Lidar"),
    "imu": ("ImuSensor",),
    "navsat": ("NavSatSensor",),
    "magnetometer": ("MagnetometerSensor",),
    "altimeter": ("AltimeterSensor",),
    "air_pressure": ("AirPressureSensor",),
    "air_speed": ("AirSpeedSensor",),
    "force_torque": ("ForceTorqueSensor",),
    "logical_camera": ("LogicalCameraSensor",),
    "dvl": ("DopplerVelocityLog",),
}
"""The files of gz-sensors that publish for a kind of sensor."""
COMPARED = tuple(_FILES)
"""The kinds of sensors that are read."""
_INFO = ("camera_info", "CameraInfo")
"""What every camera publishes through its base class, where it asks for that."""
_RENDERED = {
    "camera": "camera",
    "depth_camera": "depthCamera",
    "rgbd_camera": "rgbdCamera",
    "thermal_camera": "thermalCamera",
    "segmentation_camera": "segmentationCamera",
    "boundingbox_camera": "boundingBoxCamera",
    "wideanglecamera": "wideAngleCamera",
    "gpu_lidar": "gpuLidar",
}
"""What the rendering of gz-sim calls the suffix of a kind of sensor; other suffixes stand in the sensor's system."""
_SUFFIX = re.compile(r'\b(\w+)Suffix\s*\{\s*"/?(\w*)"\s*\}')
_SENT = re.compile(r"Advertise\s*<\s*(?:\w+::)*([A-Z]\w*)\s*>")
_FIRST_TOPIC = re.compile(r'SetTopic\s*\(\s*"[^"]*"\s*\)')
_END = re.compile(r'"(?:/(?=\w)|(?=_\w))(\w+)"')


@dataclass(frozen=True, slots=True)
class SensorSource:
    """What the source of one kind of sensor names; `suffix` is None where the rendering does not say it."""

    suffix: str | None
    topics: frozenset[str]
    messages: frozenset[str]


def sensors_in(sim: Path, sensors: Path) -> Iterator[tuple[str, SensorSource]]:
    """The kinds of sensors of a checkout of gz-sensors, with the suffixes of one of gz-sim."""
    suffixes = suffixes_in(source_text(sim / "src" / "rendering" / "RenderUtil.cc"))
    for type_, stems in _FILES.items():
        files = [sensors / "src" / f"{stem}.cc" for stem in stems]
        if files[0].is_file():
            yield type_, read_sensor("\n".join(map(source_text, files)), suffixes.get(_RENDERED.get(type_, "")))


def suffixes_in(text: str) -> dict[str, str]:
    """The suffixes of default topics by the names of their variables."""
    return {found[1]: found[2] for found in _SUFFIX.finditer(text)}


def read_sensor(text: str, suffix: str | None = None) -> SensorSource:
    """What the files of one kind of sensor publish."""
    topics = {found[1] for found in _END.finditer(_FIRST_TOPIC.sub("", text))}
    messages = {found[1] for found in _SENT.finditer(text)}
    if "AdvertiseInfo" in text:
        topics.add(_INFO[0])
        messages.add(_INFO[1])
    return SensorSource(suffix, frozenset(topics), frozenset(messages))
