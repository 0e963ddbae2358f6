"""Masses of shapes that are hollow in MJCF: `shellinertia` spreads the density of a geom over its surface, in kg/m^2.

MuJoCo takes the difference of two ellipsoids for the shell of one, and an approximation for its area.
"""

import math
from collections.abc import Callable, Mapping

from twinform.ir import Box, Capsule, Cylinder, Ellipsoid, Sphere
from twinform.ir.geometry import Shape
from twinform.ir.solids import Solid, sizes

_Moments = tuple[float, tuple[float, float, float]]
"""An area, and the moments of inertia of a shell that weighs 1 kg/m^2."""
_THOMSEN = 1.6075
"""The exponent of Thomsen's approximation of the area of an ellipsoid."""
_THIN = 1e-6
"""By how much the half axes of the outer ellipsoid are longer, in m."""


def shell(shape: Shape, density: float) -> Solid | None:
    """Return the surface of a shape with a density in kg/m^2, in the frame of the shape; None for other shapes."""
    found = _SHELLS.get(type(shape))
    if found is None:
        return None
    area, (x, y, z) = found(*sizes(shape))
    return Solid(area * density, (0.0, 0.0, 0.0), (x * density, y * density, z * density, 0.0, 0.0, 0.0))


def _sphere(radius: float) -> _Moments:
    area = 4 * math.pi * radius**2
    moment = 2 / 3 * area * radius**2
    return area, (moment, moment, moment)


def _side(radius: float, length: float) -> _Moments:
    area = 2 * math.pi * radius * length
    across = area * (6 * radius**2 + length**2) / 12
    return area, (across, across, area * radius**2)


def _cylinder(radius: float, length: float) -> _Moments:
    area, (across, _, along) = _side(radius, length)
    caps = 2 * math.pi * radius**2
    across += caps * (radius**2 / 4 + length**2 / 4)
    along += caps * radius**2 / 2
    return area + caps, (across, across, along)


def _capsule(radius: float, length: float) -> _Moments:
    area, (across, _, along) = _side(radius, length)
    caps, (moment, _, _) = _sphere(radius)
    # each half of the sphere has its center of mass in the middle of its height
    across += moment + caps * (length**2 / 4 + length * radius / 2)
    return area + caps, (across, across, along + moment)


def _box(x: float, y: float, z: float) -> _Moments:
    area, squares = 0.0, [0.0, 0.0, 0.0]
    lengths = (x, y, z)
    for axis in range(3):  # the two plates across it
        first, second = (each for each in range(3) if each != axis)
        plates = 2 * lengths[first] * lengths[second]
        area += plates
        squares[axis] += plates * lengths[axis] ** 2 / 4
        squares[first] += plates * lengths[first] ** 2 / 12
        squares[second] += plates * lengths[second] ** 2 / 12
    xx, yy, zz = squares
    return area, (yy + zz, xx + zz, xx + yy)


def _ellipsoid(x: float, y: float, z: float) -> _Moments:
    p = _THOMSEN
    area = 4 * math.pi * (((x * y) ** p + (y * z) ** p + (z * x) ** p) / 3) ** (1 / p)
    grown = (x + _THIN, y + _THIN, z + _THIN)
    outer, inner = (4 / 3 * math.pi * math.prod(each) for each in (grown, (x, y, z)))
    xx, yy, zz = (
        (outer * a * a - inner * b * b) / 5 / (outer - inner) * area for a, b in zip(grown, (x, y, z), strict=True)
    )
    return area, (yy + zz, xx + zz, xx + yy)


_SHELLS: Mapping[type, Callable[..., _Moments]] = {
    Sphere: _sphere,
    Cylinder: _cylinder,
    Capsule: _capsule,
    Box: _box,
    Ellipsoid: _ellipsoid,
}
