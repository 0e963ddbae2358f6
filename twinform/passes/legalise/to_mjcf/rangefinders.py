"""Lidars as rangefinders of MJCF: a site for each ray, whose z axis it runs along."""

import math
from collections.abc import Iterator
from typing import NamedTuple

from twinform.ir import Element, Pose, Sensor
from twinform.ir.transform import Transform
from twinform.passes.legalise.to_mjcf.said_parts import child_count, child_number, untyped
from twinform.passes.legalise.to_mjcf.sensor_parts import SensorParts, reading, single_noise
from twinform.passes.legalise.to_mjcf.sites import sensor_site
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext

MOST_RAYS = 1000
"""A lidar with more rays is carried: a site for each would be most of the file, and take most of the time."""
_SAMPLES = {"horizontal": 640, "vertical": 1}
# x of the sensor becomes z of the site
_ALONG_X = Transform.from_pose(Pose.unchecked(rpy=(0.0, math.pi / 2, 0.0)))


class Scan(NamedTuple):
    """The angles of a scan in one direction, in rad."""

    samples: int
    least: float
    most: float

    def angles(self) -> Iterator[float]:
        """Yield the angle of each ray; a single one is in the middle."""
        if self.samples == 1:
            yield (self.least + self.most) / 2
            return
        for index in range(self.samples):
            yield self.least + (self.most - self.least) * index / (self.samples - 1)


def rangefinder_parts(context: MjcfContext, sensor: Sensor, wanted: str, place: Transform) -> SensorParts | None:
    """The parts of a lidar at a place in its body; None where it has too many rays."""
    lidar = lidar_of(sensor)
    horizontal, vertical = _scan(lidar, "horizontal"), _scan(lidar, "vertical")
    if not 0 < horizontal.samples * vertical.samples <= MOST_RAYS:
        return None
    noise = single_noise([lidar.find("noise") if lidar is not None else None])
    far = child_number(lidar, "range", "max", default=0.0)
    rays = [place.compose(ray) for ray in _rays(horizontal, vertical)]
    parts = SensorParts([], [])
    for number, ray in enumerate(rays):
        site = context.name("site", f"{wanted}_ray_{number}", sensor.location)
        parts.in_body.append(sensor_site(site, ray))
        name = context.name("sensor", f"{wanted}_ray_{number}", sensor.location)
        cutoff = far if 0 < far < math.inf else None
        parts.readings.append(reading("rangefinder", name, noise, site=site, cutoff=cutoff))
    return parts


def lidar_of(sensor: Sensor) -> Element | None:
    """The parameters of a lidar, which older files call a ray."""
    lidar = untyped(sensor, "lidar")
    return untyped(sensor, "ray") if lidar is None else lidar


def _scan(lidar: Element | None, way: str) -> Scan:
    samples = child_count(lidar, "scan", way, "samples", default=_SAMPLES[way])
    least, most = (child_number(lidar, "scan", way, f"{end}_angle", default=0.0) for end in ("min", "max"))
    return Scan(samples, least, most)


def _rays(horizontal: Scan, vertical: Scan) -> Iterator[Transform]:
    """Yield the frame of each ray in the sensor, row by row: its z axis is the ray."""
    for up in vertical.angles():
        for left in horizontal.angles():
            yield Transform.from_pose(Pose.unchecked(rpy=(0.0, -up, left))).compose(_ALONG_X)
