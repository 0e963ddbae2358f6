"""Sensors of MJCF, and the sites and cameras that they are on.

A sensor of MJCF is one quantity, so that an IMU becomes three of them. What they are called begins with the name of the
sensor. Sensors of which MuJoCo has no quantity, such as a GPS, are carried.
"""

from twinform.diagnostics import rules
from twinform.ir import Element, Sensor
from twinform.ir.kinematic_tree import JointBetween
from twinform.ir.transform import Transform
from twinform.ir.verify.verify_names import report_names
from twinform.passes.legalise.to_mjcf.cameras import camera_element
from twinform.passes.legalise.to_mjcf.kept_readings import add_kept_readings
from twinform.passes.legalise.to_mjcf.rangefinders import MOST_RAYS, rangefinder_parts
from twinform.passes.legalise.to_mjcf.said_parts import untyped
from twinform.passes.legalise.to_mjcf.sensor_parts import SensorParts, reading
from twinform.passes.legalise.to_mjcf.site_sensors import SINGLE, imu_parts, single_parts, wrench_parts
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext

_LIDARS = frozenset({"gpu_lidar", "gpu_ray", "lidar", "ray"})
_CAMERAS = frozenset({
    "boundingbox", "boundingbox_camera", "camera", "depth", "depth_camera", "multicamera", "rgbd", "rgbd_camera",
    "segmentation", "segmentation_camera", "stereocamera", "thermal", "thermal_camera", "wide_angle_camera",
    "wideanglecamera",
})  # fmt: skip


def body_sensors(context: MjcfContext, body: Body) -> list[Element]:
    """The sites and cameras of a body, for the sensors of its link; two of one name, as in some URDF, are an error."""
    found: list[Element] = []
    if len({each.name for each in body.link.sensors}) < len(body.link.sensors):
        report_names("sensor", body.link.sensors, context.sink)
    for sensor in body.link.sensors:
        if not add_kept_readings(context, sensor, body):
            found += _written(context, sensor, _link_sensor(context, sensor, body))
    return found


def joint_sensors(context: MjcfContext, body: Body, held_by: JointBetween) -> list[Element]:
    """The sites for sensors on a joint, in the body that it holds."""
    found: list[Element] = []
    for sensor in held_by.joint.sensors:
        if not add_kept_readings(context, sensor, body, held_by) and sensor.type == "force_torque":
            site = _site_name(context, sensor, body)
            found += _written(context, sensor, wrench_parts(context, sensor, site, held_by, body))
    return found


def _written(context: MjcfContext, sensor: Sensor, parts: SensorParts | None) -> list[Element]:
    """Note the readings of a sensor, and return what stands in the body."""
    if parts is None:
        return []
    for each in parts.readings:
        context.add("sensor", each.copy(source=sensor.source))
    context.leave(sensor, sensor)
    return parts.in_body


def _link_sensor(context: MjcfContext, sensor: Sensor, body: Body) -> SensorParts | None:
    place = context.resolve(sensor.pose, body)
    if sensor.type == "imu":
        return imu_parts(context, sensor, _site_name(context, sensor, body), place)
    if sensor.type in _CAMERAS:
        return _camera_parts(context, sensor, body, place)
    if sensor.type in _LIDARS:
        return _lidar_parts(context, sensor, body, place)
    if sensor.type == "contact":
        return _contact_parts(context, sensor, body)
    if sensor.type in SINGLE:
        return single_parts(context, sensor, _site_name(context, sensor, body), place)
    return None


def _camera_parts(context: MjcfContext, sensor: Sensor, body: Body, place: Transform) -> SensorParts | None:
    cameras = [part.element for part in sensor.opaque if part.element and part.element.name == "camera"]
    made = [element for each in cameras if (element := camera_element(context, sensor, each, body, place)) is not None]
    return SensorParts(made, []) if made else None


def _lidar_parts(context: MjcfContext, sensor: Sensor, body: Body, place: Transform) -> SensorParts | None:
    made = rangefinder_parts(context, sensor, context.wish("site", body.scope, sensor.name or "lidar"), place)
    if made is None:
        message = f"lidar {sensor.name!r} has no or more than {MOST_RAYS} rays, and MuJoCo needs a site for each"
        context.account(rules.NOT_IN_MJCF, message, sensor.location, 0)
    return made


def _contact_parts(context: MjcfContext, sensor: Sensor, body: Body) -> SensorParts | None:
    """A reading for each collision that a contact sensor names: how many contacts it has, and their force."""
    parameters = untyped(sensor, "contact")
    names = [each.text for each in parameters.children if each.name == "collision"] if parameters is not None else []
    made: list[Element] = []
    for each in body.link.collisions:
        geom = context.written_geoms.get(id(each))
        if geom is not None and each.name in names:
            own = f"{sensor.name}" if len(names) == 1 else f"{sensor.name}_{each.name}"
            name = context.name("sensor", context.wish("sensor", body.scope, own), sensor.location)
            made.append(make_contact(name, geom))
    return SensorParts([], made) if made else None


def make_contact(name: str | None, geom: str) -> Element:
    """The reading of the contacts of a geom."""
    return reading("contact", name, geom1=geom, data="found force", num=1, reduce="netforce")


def _site_name(context: MjcfContext, sensor: Sensor, body: Body) -> str:
    wanted = context.wish("site", body.scope, sensor.name or sensor.type or "sensor")
    return context.name("site", wanted, sensor.location) or wanted
