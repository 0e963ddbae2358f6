"""What the sources of gz-sensors and gz-sim have about sensors: suffixes of default topics, topics and messages."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from reports.who_reads_it.cpp_source import source_text

_SOURCES = {
    "camera": ("camera", "CameraSensor"),
    "depth_camera": ("depthCamera", "DepthCameraSensor"),
    "rgbd_camera": ("rgbdCamera", "RgbdCameraSensor"),
    "thermal_camera": ("thermalCamera", "ThermalCameraSensor"),
    "segmentation_camera": ("segmentationCamera", "SegmentationCameraSensor"),
    "boundingbox_camera": ("boundingBoxCamera", "BoundingBoxCameraSensor"),
    "wideanglecamera": ("wideAngleCamera", "WideAngleCameraSensor"),
    "gpu_lidar": ("gpuLidar", "GpuLidarSensor", "Lidar"),
    "imu": ("", "ImuSensor"),
    "navsat": ("", "NavSatSensor"),
    "magnetometer": ("", "MagnetometerSensor"),
    "altimeter": ("", "AltimeterSensor"),
    "air_pressure": ("", "AirPressureSensor"),
    "air_speed": ("", "AirSpeedSensor"),
    "force_torque": ("", "ForceTorqueSensor"),
    "logical_camera": ("", "LogicalCameraSensor"),
    "dvl": ("", "DopplerVelocityLog"),
}
"""What the rendering of gz-sim calls the suffix of a kind of sensor (others have it in the sensor's system), and the
files of gz-sensors that publish for it."""
COMPARED = tuple(_SOURCES)
"""The kinds of sensors that are read."""
_INFO = ("camera_info", "CameraInfo")
"""What every camera publishes through its base class, where it asks for that."""
_SUFFIX = re.compile(r'\b(\w+)Suffix\s*\{\s*"/?(\w*)"\s*\}')
_SENT = re.compile(r"Advertise\s*<\s*(?:\w+::)*([A-Z]\w*)\s*>")
_FIRST_TOPIC = re.compile(r'SetTopic\s*\(\s*"[^"]*"\s*\)')
_END = re.compile(r'"(?:/(?=\w)|(?=_\w))(\w+)"')


@dataclass(frozen=True, slots=True)
class SensorSource:
    """What the source of one kind of sensor names; `suffix` is None where the rendering does not have it."""

    suffix: str | None
    topics: frozenset[str]
    messages: frozenset[str]


def sensors_in(sim: Path, sensors: Path) -> Iterator[tuple[str, SensorSource]]:
    """The kinds of sensors of a checkout of gz-sensors, with the suffixes of one of gz-sim."""
    suffixes = suffixes_in(source_text(sim / "src" / "rendering" / "RenderUtil.cc"))
    for type_, (rendered, *stems) in _SOURCES.items():
        files = [sensors / "src" / f"{stem}.cc" for stem in stems]
        if files[0].is_file():
            yield type_, read_sensor("\n".join(map(source_text, files)), suffixes.get(rendered))


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
