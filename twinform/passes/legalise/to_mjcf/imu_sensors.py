"""IMU sensors as an accelerometer, a gyroscope and an orientation on one site of MJCF.

Both measure the acceleration without gravity: at rest they report 9.81 m/s^2 upward.
"""

from twinform.ir import Sensor
from twinform.ir.transform import Transform
from twinform.passes.legalise.to_mjcf.said_parts import child_text, untyped
from twinform.passes.legalise.to_mjcf.sensor_parts import SensorParts, common_noise, reading
from twinform.passes.legalise.to_mjcf.sites import sensor_site
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext

_FALSE = frozenset({"false", "0"})


def imu_parts(context: MjcfContext, sensor: Sensor, site: str, place: Transform) -> SensorParts:
    """The parts of an IMU at a place in its body.

    The orientation is that in the world; SDF counts it from the one at the start unless told otherwise.
    """
    where = sensor.location
    readings = [
        reading(
            kind,
            context.name("sensor", f"{site}_{kind}", where),
            common_noise(sensor, "imu", group),
            site=site,
        )
        for kind, group in (("accelerometer", "linear_acceleration"), ("gyro", "angular_velocity"))
    ]
    if child_text(untyped(sensor, "imu"), "enable_orientation") not in _FALSE:
        name = context.name("sensor", f"{site}_framequat", where)
        readings.append(reading("framequat", name, objtype="site", objname=site))
    return SensorParts([sensor_site(site, place)], readings)
