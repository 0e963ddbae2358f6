"""Sensors of SDF as quantities of one site of MJCF: IMUs, altimeters, magnetometers and force-torque sensors.

An IMU is an accelerometer, a gyroscope and an orientation. Both languages measure the acceleration without gravity: at
rest it is 9.81 m/s^2 upward.

A force-torque sensor is a force and a torque in the body that its joint moves. MuJoCo reports what the parent does to
the child, in the axes of the site and about its origin. SDF has these axes in `frame`: those of the sensor, the child
or the parent. With `parent_to_child` SDF has the same sign, and with `child_to_parent`, its default, the opposite one
(gz-sensors, ForceTorqueSensor::Update).
"""

from twinform.diagnostics import Fate, rules
from twinform.ir import Sensor
from twinform.ir.defaults import FORCE_TORQUE
from twinform.ir.kinematic_tree import JointBetween
from twinform.ir.transform import Transform
from twinform.passes.legalise.to_mjcf.said_parts import child_text, untyped
from twinform.passes.legalise.to_mjcf.sensor_parts import SensorParts, common_noise, reading
from twinform.passes.legalise.to_mjcf.sites import sensor_site
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext

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


SINGLE = frozenset({"altimeter", "magnetometer"})
"""The types of sensors that are one quantity in MuJoCo."""


def single_parts(context: MjcfContext, sensor: Sensor, site: str, place: Transform) -> SensorParts:
    """The parts of a sensor that MuJoCo has one quantity for: its height is the third number of the position."""
    name = context.name("sensor", site, sensor.location)
    if sensor.type == "magnetometer":
        made = reading("magnetometer", name, site=site)
    else:
        made = reading("framepos", name, objtype="site", objname=site)
    return SensorParts([sensor_site(site, place)], [made])


def wrench_parts(context: MjcfContext, sensor: Sensor, site: str, joint: JointBetween, body: Body) -> SensorParts:
    """The parts of a sensor on the joint that holds a body."""
    where = sensor.location
    readings = [
        reading(kind, context.name("sensor", f"{site}_{kind}", where), noise, site=site)
        for kind in ("force", "torque")
        for noise in (common_noise(sensor, "force_torque", kind),)
    ]
    _report_differences(context, sensor, joint)
    at = _place(context, sensor, joint, body)
    return SensorParts([sensor_site(site, at)], readings)


def _place(context: MjcfContext, sensor: Sensor, joint: JointBetween, body: Body) -> Transform:
    """The origin of the sensor, with the axes that it reports in, in the frame of the body."""
    joint_place = context.place(joint.name, body.name, kind="joint")
    if sensor.pose is not None and sensor.pose.relative_to:
        origin = context.resolve(sensor.pose, body)
    else:
        origin = joint_place.compose(Transform.from_pose(sensor.pose))
    match setting(sensor, "frame"):
        case "child":
            axes = Transform()
        case "parent":
            axes = context.place(joint.parent, body.name) if joint.parent in context.tree.links else joint_place
        case _:
            return origin
    return Transform(origin.translation, axes.rotation)


def setting(sensor: Sensor, name: str) -> str:
    """The value of `frame` or `measure_direction`, or its default."""
    return child_text(untyped(sensor, "force_torque"), name) or FORCE_TORQUE[name]


def _report_differences(context: MjcfContext, sensor: Sensor, joint: JointBetween) -> None:
    """Enter into the ledger what MuJoCo reports otherwise."""
    if setting(sensor, "measure_direction") == "child_to_parent":
        message = (
            f"force-torque sensor {sensor.name!r} reports what the child does to the parent; in MuJoCo its force and "
            "torque are what the parent does to the child, with the opposite sign"
        )
        context.sink.account(Fate.APPROXIMATED, rules.NOT_IN_MJCF, message, sensor.location, 0)
    if setting(sensor, "frame") == "parent" and joint.type != "fixed":
        message = (
            f"force-torque sensor {sensor.name!r} reports in the axes of the parent; in MuJoCo they turn with the child"
        )
        context.sink.account(Fate.APPROXIMATED, rules.NOT_IN_MJCF, message, sensor.location, 0)
