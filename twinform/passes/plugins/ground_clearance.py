"""Where a model stands: its base link, and how far it reaches below its own frame."""

import math
from collections.abc import Callable
from typing import Any

from twinform.ir import Box, Capsule, Cone, Cylinder, Ellipsoid, Format, Model, Shape, Sphere
from twinform.ir.defaults import sizes
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.ir.scopes import scoped_links
from twinform.ir.transform import Matrix3

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
