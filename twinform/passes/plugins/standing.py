"""How deep a model reaches below its own frame, so that it can be put on the ground."""

import math
from collections.abc import Callable, Iterator

from twinform.ir import Box, Capsule, Cone, Cylinder, Ellipsoid, Link, Model, Shape, Sphere
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.ir.transform import Matrix3


def lowest_point(model: Model) -> float | None:
    """The lowest height that the model's collisions reach in its frame, in m, with all joints at zero.

    None where a collision is a mesh or another shape without a closed form, or where there is none.
    """
    graph, heights = FrameGraph(model), list[float]()
    try:
        for name, link in _links(model):
            for each in link.collisions:
                at = graph.resolve(each.pose, name, MODEL, base="model")
                reach = _reach(each.geometry.shape if each.geometry else None, at.rotation)
                if reach is None:
                    return None
                heights.append(at.translation[2] - reach)
    except FrameError:
        return None
    return min(heights, default=None)


def _links(model: Model) -> Iterator[tuple[str, Link]]:
    stack = [("", model)]
    while stack:
        scope, each = stack.pop()
        yield from ((f"{scope}{link.name}", link) for link in each.links)
        stack.extend((f"{scope}{inner.name}::", inner) for inner in each.models)


def _reach(shape: Shape | None, rotation: Matrix3) -> float | None:
    """How far a turned shape reaches down from its origin: the support function at -z."""
    for kind, reach in _REACHES.items():
        if isinstance(shape, kind):
            found = reach(shape, rotation[6:9])
            return found if math.isfinite(found) else None
    return None


Row = tuple[float, float, float]
"""The last row of a rotation: how much of each axis of the shape points up."""


def _box(shape: Box, up: Row) -> float:
    return sum(abs(part) * size / 2 for part, size in zip(up, shape.size or (1.0, 1.0, 1.0), strict=True))


def _sphere(shape: Sphere, _: Row) -> float:
    return _or(shape.radius, 1.0)


def _cylinder(shape: Cylinder, up: Row) -> float:
    return _or(shape.radius, 1.0) * math.hypot(up[0], up[1]) + abs(up[2]) * _or(shape.length, 1.0) / 2


def _capsule(shape: Capsule, up: Row) -> float:
    return _or(shape.radius, 0.5) + abs(up[2]) * _or(shape.length, 1.0) / 2


def _cone(shape: Cone, up: Row) -> float:
    half = _or(shape.length, 1.0) / 2
    base = _or(shape.radius, 0.5) * math.hypot(up[0], up[1]) + up[2] * half
    return max(base, -up[2] * half)


def _ellipsoid(shape: Ellipsoid, up: Row) -> float:
    return math.hypot(*(part * radius for part, radius in zip(up, shape.radii or (1.0, 1.0, 1.0), strict=True)))


def _or(value: float | None, default: float) -> float:
    return default if value is None else value


_REACHES: dict[type[Shape], Callable[..., float]] = {
    Box: _box,
    Sphere: _sphere,
    Cylinder: _cylinder,
    Capsule: _capsule,
    Cone: _cone,
    Ellipsoid: _ellipsoid,
}
