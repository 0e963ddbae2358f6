"""Primitives that MuJoCo fits to meshes: a geom of type box with a mesh is the box that moves as the mesh does.

A mesh is measured in its principal axes, the greatest moment first, so that the shortest side of a box comes first. It
is replaced by a box with its mass and moments or, with `fitaabb`, by the one around its points; other shapes are as
large as these boxes. `<tf:fitted>` says where the mesh was in the shape, so that the geom comes back while its size is
that of the mesh.
"""

import math
from collections.abc import Callable, Mapping
from typing import NamedTuple

from twinform.compiler.input.mjcf.lower_shapes import PlacedShape
from twinform.compiler.input.mjcf.pieces import Piece
from twinform.ir import Box, Capsule, Cylinder, Ellipsoid, Sphere
from twinform.ir.geometry import Shape
from twinform.ir.node import Vector3
from twinform.ir.solids import Solid, principal_axes
from twinform.ir.transform import Matrix3, Transform, cross


class MeasuredMesh(NamedTuple):
    """A mesh: its solid with a density of one, and the coordinates of its points as doubles, x y z of each."""

    solid: Solid
    points: bytes = b""


def _capsule(x: float, y: float, z: float) -> Shape:
    radius = (x + y) / 2
    return Capsule.unchecked(radius=radius, length=2 * max(z - radius / 2, 0.0))


def _capsule_around(x: float, y: float, z: float) -> Shape:
    radius = max(x, y)
    return Capsule.unchecked(radius=radius, length=2 * max(z - radius, 0.0))


_ALIKE: Mapping[str, Callable[[float, float, float], Shape]] = {
    "box": lambda x, y, z: Box.unchecked(size=(2 * x, 2 * y, 2 * z)),
    "ellipsoid": lambda x, y, z: Ellipsoid.unchecked(radii=(x, y, z)),
}
_TO_MOMENTS: Mapping[str, Callable[[float, float, float], Shape]] = {
    **_ALIKE,
    "sphere": lambda x, y, z: Sphere.unchecked(radius=(x + y + z) / 3),
    "capsule": _capsule,
    "cylinder": lambda x, y, z: Cylinder.unchecked(radius=(x + y) / 2, length=2 * z),
}
"""What is fitted to a box with the moments of a mesh, by its half sides, of which the last is the longest."""
_TO_POINTS: Mapping[str, Callable[[float, float, float], Shape]] = {
    **_ALIKE,
    "sphere": lambda x, y, z: Sphere.unchecked(radius=max(x, y, z)),
    "capsule": _capsule_around,
    "cylinder": lambda x, y, z: Cylinder.unchecked(radius=max(x, y), length=2 * z),
}
"""What is fitted to the box around the points of a mesh."""
FITTED = frozenset(_TO_MOMENTS)
"""The types of geoms that MuJoCo fits to a mesh."""


def is_fitted(geom: Piece) -> bool:
    """Tell whether a geom is a primitive with the size of a mesh."""
    return geom.has("mesh") and (geom.peek("type") or "sphere") in FITTED


def fit(geom: Piece, mesh: MeasuredMesh, *, by_bounds: bool) -> PlacedShape | None:
    """Return the shape that is fitted to a mesh, in the frame of the mesh; None for a mesh without a mass."""
    if not mesh.solid.mass > 0:
        return None
    kind, scale = geom.peek("type") or "sphere", next(iter(geom.peek_numbers("fitscale")), 1.0)
    moments, axes = principal_axes(mesh.solid.inertia)
    (a, u), (b, v), (c, w) = sorted(zip(moments, axes, strict=True), reverse=True)
    if sum(x * y for x, y in zip(cross(u, v), w, strict=True)) < 0:
        w = (-w[0], -w[1], -w[2])
    at = Transform(mesh.solid.center, (u[0], v[0], w[0], u[1], v[1], w[1], u[2], v[2], w[2]))
    if by_bounds:
        middle, half = _bounds(mesh.points, mesh.solid.center, at.rotation)
        at, shapes = at.compose(Transform(middle)), _TO_POINTS
    else:
        half, shapes = _equal_box((a, b, c), mesh.solid.mass), _TO_MOMENTS
    x, y, z = (scale * each for each in half)
    return PlacedShape(shapes[kind](x, y, z), at, at.inverse())


def _equal_box(moments: Vector3, mass: float) -> Vector3:
    """Return half the sides of a box with these moments."""
    whole = sum(moments)
    x, y, z = (math.sqrt(max(whole - 2 * each, 0.0) * 1.5 / mass) for each in moments)
    return x, y, z


def _bounds(points: bytes, center: Vector3, axes: Matrix3) -> tuple[Vector3, Vector3]:
    """Return the middle of the box around points and half its sides, in axes at a center."""
    import numpy as np  # noqa: PLC0415 - only meshes need it

    turned = (np.frombuffer(points).reshape(-1, 3) - center) @ np.array(axes).reshape(3, 3)
    least, most = turned.min(axis=0), turned.max(axis=0)
    (x, y, z), (i, j, k) = map(float, (least + most) / 2), map(float, (most - least) / 2)
    return (x, y, z), (i, j, k)
