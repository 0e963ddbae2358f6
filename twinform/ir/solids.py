"""Mass, centre of mass and inertia of shapes that are filled evenly, and of several together."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from twinform.ir.geometry import Box, Capsule, Cone, Cylinder, Ellipsoid, ShapeNode, Sphere
from twinform.ir.node import Vector3
from twinform.ir.principal_moments import Symmetric
from twinform.ir.transform import Transform

_ORIGIN: Vector3 = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Solid:
    """A mass in kg, its centre in m, and the inertia in kg m^2 about that centre, in the axes of the same frame."""

    mass: float
    centre: Vector3
    inertia: Symmetric


def solid(shape: ShapeNode | None, density: float) -> Solid | None:
    """A shape filled with a density in kg/m^3, in the frame of the shape; None where the shape has no inside.

    Sizes that are not written are SDF's defaults.
    """
    make = _SOLIDS.get(type(shape))
    if make is None:
        return None
    volume, centre, squares = make(shape)
    xx, yy, zz = squares
    mass = density * volume
    return Solid(mass, (0.0, 0.0, centre), (mass * (yy + zz), mass * (xx + zz), mass * (xx + yy), 0.0, 0.0, 0.0))


_Moments = tuple[float, float, Vector3]
"""Volume in m^3, height of the centre in m, and the mean of x^2, y^2 and z^2 about the centre, in m^2.

A moment of inertia is the mass times two of these means: Ixx = m (<y^2> + <z^2>). The moments are those of L. D. Landau
and E. M. Lifshitz, Mechanics, section 32, problem 2.
"""


def _box(shape: Box) -> _Moments:
    """Sides a, b, c: Ixx = m (b^2 + c^2) / 12; problem 2 (d)."""
    a, b, c = shape.size or (1.0, 1.0, 1.0)
    return a * b * c, 0.0, (a * a / 12, b * b / 12, c * c / 12)


def _sphere(shape: Sphere) -> _Moments:
    """Radius r: I = 2/5 m r^2; problem 2 (b)."""
    r = _or(shape.radius, 1.0)
    return 4 / 3 * math.pi * r * r * r, 0.0, (r * r / 5, r * r / 5, r * r / 5)


def _ellipsoid(shape: Ellipsoid) -> _Moments:
    """Semi-axes a, b, c: Ixx = m (b^2 + c^2) / 5; problem 2 (f)."""
    a, b, c = shape.radii or (1.0, 1.0, 1.0)
    return 4 / 3 * math.pi * a * b * c, 0.0, (a * a / 5, b * b / 5, c * c / 5)


def _cylinder(shape: Cylinder) -> _Moments:
    """Radius r, length h: Izz = m r^2 / 2, Ixx = m (r^2 + h^2 / 3) / 4; problem 2 (c)."""
    r, h = _or(shape.radius, 1.0), _or(shape.length, 1.0)
    return math.pi * r * r * h, 0.0, (r * r / 4, r * r / 4, h * h / 12)


def _cone(shape: Cone) -> _Moments:
    """Radius r, length h: Izz = 3/10 m r^2, Ixx = 3/20 m (r^2 + h^2 / 4), centre h/4 above the base; problem 2 (e)."""
    r, h = _or(shape.radius, 1.0), _or(shape.length, 1.0)
    return math.pi * r * r * h / 3, -h / 4, (3 / 20 * r * r, 3 / 20 * r * r, 3 / 80 * h * h)


def _capsule(shape: Capsule) -> _Moments:
    """A cylinder of radius r and length h, and the halves of a sphere with their flat sides at -h/2 and h/2.

    About its flat side a half sphere has <z^2> = r^2 / 5 as the whole has, and its centre is 3/8 r above: problem 2 (b)
    and the integral of z over it. Moved by h/2, <z^2> is r^2 / 5 + 3/8 r h + h^2 / 4.
    """
    r, h = _or(shape.radius, 0.5), _or(shape.length, 1.0)
    middle, ends = math.pi * r * r * h, 4 / 3 * math.pi * r * r * r
    whole = middle + ends
    if not whole:
        return 0.0, 0.0, _ORIGIN
    across = (middle * r * r / 4 + ends * r * r / 5) / whole
    along = (middle * h * h / 12 + ends * (r * r / 5 + 3 / 8 * r * h + h * h / 4)) / whole
    return whole, 0.0, (across, across, along)


_SOLIDS: dict[type[Any], Callable[[Any], _Moments]] = {
    Box: _box,
    Sphere: _sphere,
    Ellipsoid: _ellipsoid,
    Cylinder: _cylinder,
    Cone: _cone,
    Capsule: _capsule,
}


def _or(value: float | None, default: float) -> float:
    return default if value is None else value


def placed(one: Solid, at: Transform) -> Solid:
    """A solid seen from the frame that `at` places its own in: R I R^T."""
    rows = (at.rotation[0:3], at.rotation[3:6], at.rotation[6:9])
    xx, yy, zz, xy, xz, yz = one.inertia
    matrix = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    half = [[sum(row[k] * matrix[k][j] for k in range(3)) for j in range(3)] for row in rows]

    def entry(i: int, j: int) -> float:
        return sum(half[i][k] * rows[j][k] for k in range(3)) + 0.0

    turned = (entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2))
    return Solid(one.mass, at.apply(one.centre), turned)


def combined(parts: Sequence[Solid]) -> Solid:
    """Several solids of one frame as one, each inertia moved to the common centre by the parallel axis theorem."""
    mass = math.fsum(part.mass for part in parts)
    if not mass:
        return Solid(0.0, _ORIGIN, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    x, y, z = (math.fsum(part.mass * part.centre[i] for part in parts) / mass for i in range(3))
    moved = [_about(part, (x, y, z)) for part in parts]
    xx, yy, zz, xy, xz, yz = (math.fsum(entries) for entries in zip(*moved, strict=True))
    return Solid(mass, (x, y, z), (xx, yy, zz, xy, xz, yz))


def _about(part: Solid, centre: Vector3) -> Symmetric:
    """The inertia of a part about another point: I + m (d^2 - d d^T)."""
    x, y, z = (a - b for a, b in zip(part.centre, centre, strict=True))
    m = part.mass
    xx, yy, zz, xy, xz, yz = part.inertia
    return (
        xx + m * (y * y + z * z), yy + m * (x * x + z * z), zz + m * (x * x + y * y),
        xy - m * x * y, xz - m * x * z, yz - m * y * z,
    )  # fmt: skip


def with_mass(one: Solid, mass: float) -> Solid:
    """The same solid, filled so that it has this mass."""
    factor = mass / one.mass if one.mass else 0.0
    xx, yy, zz, xy, xz, yz = (element * factor for element in one.inertia)
    return Solid(mass, one.centre, (xx, yy, zz, xy, xz, yz))
