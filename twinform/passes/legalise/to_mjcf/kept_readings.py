"""Readings that a sensor of SDF keeps of the file of MJCF that it was read from, written again while they are it.

What a sensor says itself counts: on what it is and where, of what type it is, and what it measures. Its name, and the
collisions of which it tells contacts, stand in a carrier where reading would make others.
"""

import math
from collections.abc import Iterator

from twinform.ir import Element, Sensor
from twinform.ir.kinematic_tree import JointBetween
from twinform.ir.pose import Pose
from twinform.ir.transform import Transform
from twinform.passes.carriers.old_names import source_name
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements
from twinform.passes.legalise.to_mjcf.said_parts import child_number, child_text, untyped
from twinform.passes.legalise.to_mjcf.writing_context import Body, KeptSensor, MjcfContext, ScopedFrame

_TYPES = {
    **dict.fromkeys(("accelerometer", "gyro"), "imu"),
    **dict.fromkeys(("force", "torque"), "force_torque"),
    "touch": "contact",
    "rangefinder": "gpu_lidar",
    "magnetometer": "magnetometer",
}
"""The types of sensors that readings at a site are read as."""
_CLOSE = 1e-9
_PRINTED = 1e-5
"""How far the reach of a ray may be from its cutoff, as a part of it: it is read with six digits."""
_OF_RAYS = frozenset({"lidar", "scan", "horizontal", "samples", "min_angle", "max_angle", "range", "min", "max"})
_Z_TO_X = Transform.from_pose(Pose.unchecked(quat_xyzw=(0.0, -math.sqrt(0.5), 0.0, math.sqrt(0.5))))
"""What turns x, along which a lidar looks, onto z, along which a rangefinder does."""
_FARTHEST = 100.0
"""How far in m a rangefinder without a cutoff is read to reach."""


def add_kept_readings(context: MjcfContext, sensor: Sensor, body: Body, joint: JointBetween | None = None) -> bool:
    """Add the readings that a sensor of a body, or of the joint that holds it, keeps; tell whether it has any.

    Where the sensor has become another one since, they are reported and left out.
    """
    kept = [reading for each in kept_elements(sensor) if each.name == "sensor" for reading in each.children]
    if not kept:
        return False
    site = next(_sites(context, sensor, body, joint, kept), None)
    if site is None or not _measures(sensor, body, kept) or _are_written(context, kept):
        message = f"<{kept[0].name}> is kept for sensor {sensor.name!r}, which is another one by now"
        context.drop_stale(message, sensor.location, kept[0].name, len(kept))
        return False
    written = context.written_sites[site.name]
    context.kept_readings += [("", _at(each, written)) for each in kept]
    names = {source_name(site.frame), site.frame.name}
    names = {written} if written in names else names
    read = sensor.name if sensor.name in {f"{each}_{sensor.type}" for each in names} else None
    name = read or f"{written.replace('::', '__')}_{sensor.type}"
    context.kept_sensors[id(sensor.source)] = KeptSensor(name, _collisions(sensor) == _touching(body))
    return True


def _sites(
    context: MjcfContext, sensor: Sensor, body: Body, joint: JointBetween | None, kept: list[Element]
) -> Iterator[ScopedFrame]:
    """Yield the frames of a body that are where a sensor is: first the one that its pose names, then that of before."""
    pose = sensor.pose or Pose.unchecked()
    place = context.resolve(pose, body)
    if joint is not None and not pose.relative_to:
        place = context.place(joint.name, body.name, kind="joint").compose(Transform.from_pose(pose))
    turn = _Z_TO_X if sensor.type == "gpu_lidar" else Transform()
    named = (body.scope + (pose.relative_to or ""), kept[0].get("site"))

    def rank(each: ScopedFrame) -> tuple[bool, bool]:
        return each.name != named[0], context.written_sites.get(each.name) != named[1]

    for each in sorted(context.frames_by_link.get(body.name, ()), key=rank):
        there = context.place(each.name, body.name, kind="frame").compose(turn)
        if each.name in context.written_sites and _is_near(place, there):
            yield each


def _is_near(one: Transform, other: Transform) -> bool:
    numbers = zip((*one.translation, *one.rotation), (*other.translation, *other.rotation), strict=True)
    return all(math.isclose(a, b, rel_tol=_CLOSE, abs_tol=_CLOSE) for a, b in numbers)


def _measures(sensor: Sensor, body: Body, kept: list[Element]) -> bool:
    """Whether readings measure what a sensor does."""
    if any(_TYPES.get(each.name) != sensor.type for each in kept):
        return False
    match sensor.type:
        case "contact":
            return not set(_touching(body)).isdisjoint(_collisions(sensor))
        case "gpu_lidar":
            farthest = float(kept[0].get("cutoff") or 0.0) or _FARTHEST
            return _is_one_ray(untyped(sensor, "lidar"), farthest)
        case "force_torque":
            words = [child_text(untyped(sensor, "force_torque"), each) for each in ("frame", "measure_direction")]
            return words == ["sensor", "parent_to_child"]
        case _:
            return True


def _is_one_ray(lidar: Element | None, farthest: float) -> bool:
    """Whether a lidar is what a rangefinder is read as: a ray straight ahead, with nothing else that could be said."""
    if lidar is None or not {each.name for each in lidar.walk()} <= _OF_RAYS:
        return False
    samples = child_number(lidar, "scan", "horizontal", "samples", default=1.0)
    angles = [child_number(lidar, "scan", "horizontal", each, default=0.0) for each in ("min_angle", "max_angle")]
    nearest, reach = (child_number(lidar, "range", each, default=0.0) for each in ("min", "max"))
    return (samples, *angles, nearest) == (1.0, 0.0, 0.0, 0.0) and math.isclose(reach, farthest, rel_tol=_PRINTED)


def _are_written(context: MjcfContext, kept: list[Element]) -> bool:
    """Whether another sensor has kept the same readings: a copy of it."""
    known = {(each.name, each.get("name")) for _, each in context.kept_readings}
    return any(each.get("name") and (each.name, each.get("name")) in known for each in kept)


def _collisions(sensor: Sensor) -> tuple[str | None, ...]:
    """The collisions of whose contacts a sensor tells."""
    contact = untyped(sensor, "contact")
    return tuple(each.text for each in contact.find_all("collision")) if contact is not None else ()


def _touching(body: Body) -> tuple[str | None, ...]:
    return tuple(each.name for each in body.link.collisions)


def _at(reading: Element, site: str) -> Element:
    return reading.copy(attributes=tuple((key, site if key == "site" else value) for key, value in reading.attributes))
