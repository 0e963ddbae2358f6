"""Boxes along the axes of a frame that hold shapes."""

from collections.abc import Callable, Iterable
from typing import Any

from twinform.dataclass import dataclass
from twinform.ir.defaults import sizes
from twinform.ir.geometry import Box, Capsule, Cone, Cylinder, Ellipsoid, ShapeNode, Sphere
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform


@dataclass(frozen=True, slots=True)
class Bounds:
    """An axis-aligned box between two corners, in meters."""

    least: Vector3
    greatest: Vector3

    @property
    def size(self) -> Vector3:
        """The extent along x, y and z."""
        x, y, z = (high - low for low, high in zip(self.least, self.greatest, strict=True))
        return x, y, z

    def distance(self, point: Vector3) -> float:
        """Return how far a point is outside, along the worst axis; zero or less inside."""
        sides = zip(self.least, point, self.greatest, strict=True)
        return max(max(low - at, at - high) for low, at, high in sides)


def bounds(shape: ShapeNode | None) -> Bounds | None:
    """Return the box around a shape, in the shape's frame; None for shapes without known ends.

    Sizes that are not written are SDF's defaults.
    """
    halves = _HALVES.get(type(shape))
    if shape is None or halves is None:
        return None
    x, y, z = map(abs, halves(*sizes(shape)))
    return Bounds((-x, -y, -z), (x, y, z))


def _box(x: float, y: float, z: float) -> Vector3:
    return x / 2, y / 2, z / 2


def _sphere(radius: float) -> Vector3:
    return radius, radius, radius


def _ellipsoid(x: float, y: float, z: float) -> Vector3:
    return x, y, z


def _round(radius: float, length: float) -> Vector3:
    return radius, radius, length / 2


def _capsule(radius: float, length: float) -> Vector3:
    return radius, radius, length / 2 + radius


_HALVES: dict[type[Any], Callable[..., Vector3]] = {
    Box: _box,
    Sphere: _sphere,
    Ellipsoid: _ellipsoid,
    Cylinder: _round,
    Cone: _round,
    Capsule: _capsule,
}
"""Half the extent of each shape along x, y and z."""


def placed_bounds(box: Bounds, at: Transform) -> Bounds:
    """Return the box around a box that `at` places in another frame; not the smallest one if it is turned."""
    half = [size / 2 for size in box.size]
    middle = [(low + high) / 2 for low, high in zip(box.least, box.greatest, strict=True)]
    x, y, z = at.apply((middle[0], middle[1], middle[2]))
    r = [abs(entry) for entry in at.rotation]
    a, b, c = (sum(r[3 * row + i] * half[i] for i in range(3)) for row in range(3))
    return Bounds((x - a, y - b, z - c), (x + a, y + b, z + c))


def united(boxes: Iterable[Bounds]) -> Bounds | None:
    """Return the box around several boxes; None for none."""
    listed = tuple(boxes)
    if not listed:
        return None
    x, y, z = (min(axis) for axis in zip(*(box.least for box in listed), strict=True))
    a, b, c = (max(axis) for axis in zip(*(box.greatest for box in listed), strict=True))
    return Bounds((x, y, z), (a, b, c))
