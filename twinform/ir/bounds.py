"""Boxes along the axes of a frame that hold shapes."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from twinform.ir.geometry import Box, Capsule, Cone, Cylinder, Ellipsoid, ShapeNode, Sphere
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform


@dataclass(frozen=True, slots=True)
class Bounds:
    """All points between two corners, in metres."""

    least: Vector3
    greatest: Vector3

    @property
    def size(self) -> Vector3:
        """The extent along x, y and z."""
        x, y, z = (high - low for low, high in zip(self.least, self.greatest, strict=True))
        return x, y, z

    def distance(self, point: Vector3) -> float:
        """How far a point is outside, along the axis where it is farthest; zero or less where it is inside."""
        sides = zip(self.least, point, self.greatest, strict=True)
        return max(max(low - at, at - high) for low, at, high in sides)


def bounds(shape: ShapeNode | None) -> Bounds | None:
    """The box around a shape, in its own frame; None for shapes without known ends.

    Sizes that are not written are SDF's defaults.
    """
    halves = _HALVES.get(type(shape))
    if halves is None:
        return None
    x, y, z = map(abs, halves(shape))
    return Bounds((-x, -y, -z), (x, y, z))


_HALVES: dict[type[Any], Callable[[Any], Vector3]] = {
    Box: lambda shape: _scaled(shape.size, 0.5),
    Sphere: lambda shape: _round(_or(shape.radius, 1.0), _or(shape.radius, 1.0)),
    Ellipsoid: lambda shape: _scaled(shape.radii, 1.0),
    Cylinder: lambda shape: _round(_or(shape.radius, 1.0), _or(shape.length, 1.0) / 2),
    Cone: lambda shape: _round(_or(shape.radius, 1.0), _or(shape.length, 1.0) / 2),
    Capsule: lambda shape: _round(_or(shape.radius, 0.5), _or(shape.length, 1.0) / 2 + _or(shape.radius, 0.5)),
}
"""Half the extent of each shape along x, y and z."""


def placed_bounds(box: Bounds, at: Transform) -> Bounds:
    """The box around a box that `at` places in another frame; larger than it has to be where that is turned."""
    half = [size / 2 for size in box.size]
    middle = [(low + high) / 2 for low, high in zip(box.least, box.greatest, strict=True)]
    x, y, z = at.apply((middle[0], middle[1], middle[2]))
    r = [abs(entry) for entry in at.rotation]
    a, b, c = (sum(r[3 * row + i] * half[i] for i in range(3)) for row in range(3))
    return Bounds((x - a, y - b, z - c), (x + a, y + b, z + c))


def united(boxes: Iterable[Bounds]) -> Bounds | None:
    """The box around several; None around nothing."""
    listed = tuple(boxes)
    if not listed:
        return None
    x, y, z = (min(axis) for axis in zip(*(box.least for box in listed), strict=True))
    a, b, c = (max(axis) for axis in zip(*(box.greatest for box in listed), strict=True))
    return Bounds((x, y, z), (a, b, c))


def _scaled(lengths: Vector3 | None, factor: float) -> Vector3:
    x, y, z = lengths or (1.0, 1.0, 1.0)
    return x * factor, y * factor, z * factor


def _round(radius: float, height: float) -> Vector3:
    return radius, radius, height


def _or(value: float | None, default: float) -> float:
    return default if value is None else value
