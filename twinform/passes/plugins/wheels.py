"""Geometry for drive systems: the wheels of a model, where it stands, and how far it reaches below its own frame."""

import math
from collections.abc import Callable, Iterable, Sequence
from operator import itemgetter
from typing import Any

from twinform.dataclass import dataclass
from twinform.ir import Box, Capsule, Cone, Cylinder, Ellipsoid, Format, Joint, Model, Shape, Sphere, Vector3
from twinform.ir.defaults import direction, sizes
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.ir.motion import unit
from twinform.ir.scopes import scoped_links
from twinform.ir.transform import Matrix3, Transform, cross, dot

_PARALLEL = 0.999
"""The cosine above which two directions are taken as one."""


class NotMeasuredError(Exception):
    """Something cannot be measured on the model; the message has the reason."""


@dataclass(frozen=True, slots=True)
class Wheel:
    """A wheel: the origin of its joint, the center of its shape, the direction of its axle, and its radius.

    If no shape gives a radius, the radius is None and the center is the origin.
    """

    origin: Vector3
    center: Vector3
    axle: Vector3
    radius: float | None


def wheel(model: Model, joint_name: str, format_: Format) -> Wheel:
    """The wheel that a joint turns.

    Raises:
        NotMeasuredError: there is no such joint, or no place can be found for it.
    """
    joint = next((each for each in model.joints if each.name == joint_name), None)
    if joint is None or joint.child is None:
        raise NotMeasuredError(f"there is no joint {joint_name!r}")
    try:
        graph = FrameGraph(model)
        place = graph.pose(joint.name, MODEL, kind="joint", base="model")
        axle = _find_axle(graph, joint, place, format_)
        rims = _find_rims(model, graph, _rigid_links(model, joint.child), axle)
    except FrameError as error:
        raise NotMeasuredError(error.message) from error
    if not rims:
        return Wheel(place.translation, place.translation, axle, None)
    # A wheel may have a hub or a tire beside it; the largest round shape is what touches the
    # ground.
    radius, center = max(rims, key=itemgetter(0))
    return Wheel(place.translation, center, axle, radius)


def radius_of(wheels: Iterable[Wheel]) -> float:
    """The common radius of wheels.

    Raises:
        NotMeasuredError: a wheel has no round shape, or they differ.
    """
    radii = [each.radius for each in wheels]
    if any(radius is None for radius in radii):
        raise NotMeasuredError("a wheel has no cylinder, sphere or capsule about its axle, neither to touch nor to see")
    known = [radius for radius in radii if radius is not None]
    # The drive systems of gz-sim have one radius for all wheels, so wheels that differ by more than
    # 1 % have no answer. There is no default: the system's own would be wrong for nearly every
    # robot.
    if max(known) - min(known) > 0.01 * max(known):
        raise NotMeasuredError(f"the wheels have radii from {min(known):g} to {max(known):g} m")
    return known[0]


def separation_of(left: Sequence[Wheel], right: Sequence[Wheel]) -> float:
    """The distance between the wheels of the two sides, along the axle.

    Raises:
        NotMeasuredError: the axles do not point the same way, or nothing lies between the sides.
    """
    # Measured between the middles of the shapes, not between the origins of the joints: an origin
    # may lie on the inner side of a wheel, and the shape is what touches the ground. Of 29
    # differential drives of the corpus with their joints in the file, 28 have the numbers measured
    # so; the 29th, in gz-sim's tunnel.sdf, has those of another vehicle.
    axle = _common_axle([*left, *right])
    distance = abs(
        _mean_along([each.center for each in left], axle) - _mean_along([each.center for each in right], axle)
    )
    return _require_distance(distance, "the wheels of both sides are at the same place along the axle")


def wheelbase_of(front: Sequence[Wheel], rear: Sequence[Wheel], across: Sequence[Wheel]) -> float:
    """The distance between the front and the rear axle, on the ground and at right angles to the axle of `across`.

    Raises:
        NotMeasuredError: the axles do not point the same way, or are one.
    """
    axle = _common_axle(across)
    forward = _normalize(cross(axle, (0.0, 0.0, 1.0)))
    distance = abs(
        _mean_along([each.origin for each in front], forward) - _mean_along([each.origin for each in rear], forward)
    )
    return _require_distance(distance, "the front and rear wheels are at the same place along the way")


def _require_distance(distance: float, otherwise: str) -> float:
    if not (math.isfinite(distance) and distance > 1e-9):
        raise NotMeasuredError(otherwise)
    # Nanometers: composing poses leaves 0.30000000000000004 where the author meant 0.3.
    return round(distance, 9)


def _common_axle(wheels: Sequence[Wheel]) -> Vector3:
    axle = wheels[0].axle
    if any(abs(dot(axle, each.axle)) < _PARALLEL for each in wheels):
        raise NotMeasuredError("the axles of the wheels do not point the same way")
    return axle


def _mean_along(points: Sequence[Vector3], direction: Vector3) -> float:
    return sum(dot(each, direction) for each in points) / len(points)


def _find_axle(graph: FrameGraph, joint: Joint, place: Transform, format_: Format) -> Vector3:
    axis = joint.axis
    frame = place
    if axis and axis.expressed_in:
        frame = graph.pose(axis.expressed_in, MODEL, kind="frame", base="model")
    elif axis and axis.use_parent_model_frame:
        frame = Transform()
    return _normalize(frame.rotate(direction(axis, format_)))


def _rigid_links(model: Model, link: str) -> set[str]:
    """The links that turn with a link: the link and those below it on fixed joints."""
    found = {link}
    below = {joint.child for joint in model.joints if joint.type == "fixed" and joint.parent == link} - found
    while below:
        found |= {each for each in below if each}
        below = {
            each.child for each in model.joints if each.type == "fixed" and each.parent in found and each.child
        } - found
    return found


def _find_rims(model: Model, graph: FrameGraph, links: set[str], axle: Vector3) -> list[tuple[float, Vector3]]:
    """Radius and center of the round collisions of links; of the round visuals if no collision is round."""
    here = [link for link in model.links if link.name in links]
    # Collisions first, since they touch the ground. Visuals serve where the collisions are meshes.
    for field in ("collisions", "visuals"):
        found: list[tuple[float, Vector3]] = []
        for link in here:
            for part in getattr(link, field):
                at = graph.resolve(part.pose, link.name, MODEL, base="model")
                radius = _radius_about(part.geometry.shape if part.geometry else None, at, axle)
                if radius is not None:
                    found.append((radius, at.translation))
        if found:
            return found
    return []


def _radius_about(shape: Shape | None, at: Transform, axle: Vector3) -> float | None:
    """The radius of a shape about an axle; None if it is not round about it."""
    # A sphere is round about any axle; a cylinder or capsule only where it lies along it. A
    # caster's cylinder that stands upright has no rolling radius.
    if isinstance(shape, Sphere):
        return shape.radius
    if not isinstance(shape, Cylinder | Capsule):
        return None
    along = at.rotate((0.0, 0.0, 1.0))
    return shape.radius if abs(dot(along, axle)) > _PARALLEL else None


def _normalize(vector: Vector3) -> Vector3:
    length = math.hypot(*vector)
    if length == 0.0 or not math.isfinite(length):
        raise NotMeasuredError("the axle of a wheel has no direction, or stands upright")
    return unit(vector)


@dataclass(frozen=True, slots=True)
class Measured:
    """A model to measure; `names` gives the joints or links that an option names."""

    model: Model
    format: Format
    names: Callable[[str], tuple[str, ...]]

    def __call__(self, parameter: str) -> tuple[Wheel, ...]:
        """The wheels on the joints that a parameter names."""
        return tuple(wheel(self.model, name, self.format) for name in self._named_parts(parameter))

    def middle(self, parameter: str) -> Vector3:
        """The mean position of the links that a parameter names."""
        places = [_link_position(self.model, name) for name in self._named_parts(parameter)]
        x, y, z = (sum(place[at] for place in places) / len(places) for at in range(3))
        return (x, y, z)

    def _named_parts(self, parameter: str) -> tuple[str, ...]:
        option = parameter.replace("_", "-")
        names = self.names(option)
        if not names:
            raise NotMeasuredError(f"{option} is not given")
        return names


def _link_position(model: Model, link: str) -> Vector3:
    try:
        return FrameGraph(model).pose(link, MODEL, base="model").translation
    except FrameError as error:
        raise NotMeasuredError(error.message) from error


Measure = Callable[[Measured], float]


def _measure_separation(left: str, right: str) -> Measure:
    return lambda wheels: separation_of(wheels(left), wheels(right))


def _measure_radius(*joints: str) -> Measure:
    return lambda wheels: radius_of([wheel for each in joints for wheel in wheels(each)])


def _measure_tracks(model: Measured) -> float:
    """The distance between the tracks along y, since a vehicle drives along x."""
    # Tracks are links without an axle, so the direction across is that of SDF's convention: x
    # forward, y left.
    left, right = model.middle("left_track_link"), model.middle("right_track_link")
    return _require_distance(abs(left[1] - right[1]), "the tracks of both sides are at the same place across")


_MECANUM = ("front_left_joint", "back_left_joint", "front_right_joint", "back_right_joint")

MEASURES: dict[str, dict[str, Measure]] = {
    "diff-drive": {
        "wheel_separation": _measure_separation("left_joint", "right_joint"),
        "wheel_radius": _measure_radius("left_joint", "right_joint"),
    },
    "mecanum-drive": {
        "wheel_separation": lambda wheels: separation_of(
            (*wheels(_MECANUM[0]), *wheels(_MECANUM[1])), (*wheels(_MECANUM[2]), *wheels(_MECANUM[3]))
        ),
        "wheelbase": lambda wheels: wheelbase_of(
            (*wheels(_MECANUM[0]), *wheels(_MECANUM[2])),
            (*wheels(_MECANUM[1]), *wheels(_MECANUM[3])),
            (*wheels(_MECANUM[0]), *wheels(_MECANUM[2])),
        ),
        "wheel_radius": _measure_radius(*_MECANUM),
    },
    "tracked-vehicle": {"tracks_separation": _measure_tracks},
    "ackermann-steering": {
        "wheel_separation": _measure_separation("left_joint", "right_joint"),
        "kingpin_width": lambda wheels: _ground_distance(wheels("left_steering_joint"), wheels("right_steering_joint")),
        "wheel_base": lambda wheels: wheelbase_of(
            (*wheels("left_steering_joint"), *wheels("right_steering_joint")),
            # With four driven wheels, two of them are the steered ones; the wheel base ends at the
            # rear axle.
            _rearmost(wheels("left_joint")) + _rearmost(wheels("right_joint")),
            wheels("left_joint"),
        ),
        "wheel_radius": _measure_radius("left_joint", "right_joint"),
    },
}
"""What can be measured for each system, by parameter, from the wheels of its parameters for joints."""


def _rearmost(wheels: tuple[Wheel, ...]) -> tuple[Wheel, ...]:
    """The wheel that is farthest back, against x, of the driven wheels of one side."""
    return (min(wheels, key=lambda each: each.origin[0]),)


def _ground_distance(left: Sequence[Wheel], right: Sequence[Wheel]) -> float:
    """The distance between two upright axes on the ground."""
    dx, dy = (left[0].origin[at] - right[0].origin[at] for at in (0, 1))
    return _require_distance(math.hypot(dx, dy), "both steering joints are at the same place")


Row = tuple[float, float, float]
"""The last row of a rotation: how much of each axis of the shape points up."""


def lowest_point(model: Model) -> float | None:
    """The lowest height, in m, of the collisions of a model in its frame, with all joints at zero.

    None where a collision is a mesh or another shape without a closed form, or where there is no collision.
    """
    graph, heights = FrameGraph(model), list[float]()
    try:
        for name, link in scoped_links(model):
            for each in link.collisions:
                at = graph.resolve(each.pose, name, MODEL, base="model")
                reach = _reach_below(each.geometry.shape if each.geometry else None, at.rotation)
                if reach is None:
                    return None
                heights.append(at.translation[2] - reach)
    except FrameError:
        return None
    return min(heights, default=None)


def _reach_below(shape: Shape | None, rotation: Matrix3) -> float | None:
    """How far a rotated shape reaches down from its origin: the support function at -z."""
    reach = _REACHES.get(type(shape))
    if shape is None or reach is None:
        return None
    found = reach(rotation[6:9], *sizes(shape))
    return found if math.isfinite(found) else None


def _box_reach(up: Row, x: float, y: float, z: float) -> float:
    return sum(abs(part) * size / 2 for part, size in zip(up, (x, y, z), strict=True))


def _sphere_reach(_: Row, radius: float) -> float:
    return radius


def _cylinder_reach(up: Row, radius: float, length: float) -> float:
    return radius * math.hypot(up[0], up[1]) + abs(up[2]) * length / 2


def _capsule_reach(up: Row, radius: float, length: float) -> float:
    return radius + abs(up[2]) * length / 2


def _cone_reach(up: Row, radius: float, length: float) -> float:
    half = length / 2
    base = radius * math.hypot(up[0], up[1]) + up[2] * half
    return max(base, -up[2] * half)


def _ellipsoid_reach(up: Row, x: float, y: float, z: float) -> float:
    return math.hypot(up[0] * x, up[1] * y, up[2] * z)


_REACHES: dict[type[Any], Callable[..., float]] = {
    Box: _box_reach,
    Sphere: _sphere_reach,
    Cylinder: _cylinder_reach,
    Capsule: _capsule_reach,
    Cone: _cone_reach,
    Ellipsoid: _ellipsoid_reach,
}


def base_link(model: Model, format_: Format) -> str | None:
    """The root in URDF, the canonical link in SDF: the base of the tree of transforms in ROS. None without links."""
    if not model.links:
        return None
    first = model.links[0].name
    if format_ is Format.SDF:
        return model.canonical_link or first
    children = {joint.child for joint in model.joints}
    return next((link.name for link in model.links if link.name not in children), first)
