"""Ground clearance: how far a model reaches below its own frame."""

import math
from collections.abc import Callable
from typing import Any

from twinform.ir import Box, Capsule, Cone, Cylinder, Ellipsoid, Model, Shape, Sphere
from twinform.ir.defaults import sizes
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.ir.scopes import scoped_links
from twinform.ir.transform import Matrix3


def lowest_point(model: Model) -> float | None:
    """The lowest height that the model's collisions reach in its frame, in m, with all joints at zero.

    None where a collision is a mesh or another shape without a closed form, or where there is none.
    """
    graph, heights = FrameGraph(model), list[float]()
    try:
        for name, link in scoped_links(model):
            for each in link.collisions:
                at = graph.resolve(each.pose, name, MODEL, base="model")
                reach = _reach(each.geometry.shape if each.geometry else None, at.rotation)
                if reach is None:
                    return None
                heights.append(at.translation[2] - reach)
    except FrameError:
        return None
    return min(heights, default=None)


def _reach(shape: Shape | None, rotation: Matrix3) -> float | None:
    """How far a turned shape reaches down from its origin: the support function at -z."""
    reach = _REACHES.get(type(shape))
    if shape is None or reach is None:
        return None
    found = reach(rotation[6:9], *sizes(shape))
    return found if math.isfinite(found) else None


Row = tuple[float, float, float]
"""The last row of a rotation: how much of each axis of the shape points up."""


def _box(up: Row, x: float, y: float, z: float) -> float:
    return sum(abs(part) * size / 2 for part, size in zip(up, (x, y, z), strict=True))


def _sphere(_: Row, radius: float) -> float:
    return radius


def _cylinder(up: Row, radius: float, length: float) -> float:
    return radius * math.hypot(up[0], up[1]) + abs(up[2]) * length / 2


def _capsule(up: Row, radius: float, length: float) -> float:
    return radius + abs(up[2]) * length / 2


def _cone(up: Row, radius: float, length: float) -> float:
    half = length / 2
    base = radius * math.hypot(up[0], up[1]) + up[2] * half
    return max(base, -up[2] * half)


def _ellipsoid(up: Row, x: float, y: float, z: float) -> float:
    return math.hypot(up[0] * x, up[1] * y, up[2] * z)


_REACHES: dict[type[Any], Callable[..., float]] = {
    Box: _box,
    Sphere: _sphere,
    Cylinder: _cylinder,
    Capsule: _capsule,
    Cone: _cone,
    Ellipsoid: _ellipsoid,
}
