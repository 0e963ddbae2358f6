"""Mass, center of mass and inertia of shapes that are filled evenly, and of several together; principal moments."""

import math
from collections.abc import Callable, Sequence
from typing import Any

from twinform.dataclass import dataclass
from twinform.ir.defaults import INERTIAL, MASS, MOMENT, filled, sizes
from twinform.ir.document import Format
from twinform.ir.geometry import Box, Capsule, Cone, Cylinder, Ellipsoid, ShapeNode, Sphere
from twinform.ir.link import Inertia, Inertial
from twinform.ir.node import Vector3
from twinform.ir.rewrite import replace_fields
from twinform.ir.transform import Transform, common_exponent, safe_sum, times_power

FELT = 0.03
"""A sum of moments, kg m^2, below which no inertia is too large: nobody feels it, and it keeps a simulation stable."""
Symmetric = tuple[float, float, float, float, float, float]
"""xx, yy, zz, xy, xz, yz of a symmetric 3x3 matrix."""

# The three pairs of axes: where their own two elements are in the tuple, the one off the diagonal, and the two that
# couple the pair with the third axis.
_PLANES = ((0, 1, 3, 4, 5), (0, 2, 4, 3, 5), (1, 2, 5, 3, 4))
_EPSILON = 2.0**-53
# Five or six are enough. The rest is for matrices whose elements differ by hundreds of orders of
# magnitude.
_SWEEPS = 40


Axes = tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float]]
"""Three unit vectors at right angles."""


def principal_moments(matrix: Symmetric) -> tuple[float, float, float]:
    """Return the eigenvalues, smallest first, by Jacobi's method: small ones are as exact as large ones.

    All elements have to be finite; an eigenvalue that no double holds is infinite.
    """
    exponent = common_exponent(matrix)
    entries = [*times_each(matrix, -exponent)]
    for _ in range(_SWEEPS):
        turned = [_rotate(entries, *plane) for plane in _PLANES]
        if not any(turned):
            break
    smallest, middle, largest = sorted(times_power(element, exponent) for element in entries[:3])
    return smallest, middle, largest


def relative_moments(matrix: Symmetric) -> tuple[float, float, float]:
    """Return the eigenvalues over one power of two, each below three, so that not even their sum overflows."""
    return principal_moments(times_each(matrix, -common_exponent(matrix)))


def times_each(matrix: Symmetric, exponent: int) -> Symmetric:
    """Multiply a matrix by a power of two; elements beyond the range of doubles become infinite."""
    xx, yy, zz, xy, xz, yz = (times_power(element, exponent) for element in matrix)
    return xx, yy, zz, xy, xz, yz


def principal_axes(matrix: Symmetric) -> tuple[tuple[float, float, float], Axes]:
    """Return the eigenvalues with their eigenvectors, in no order; all elements must be finite."""
    exponent = common_exponent(matrix)
    entries = [*times_each(matrix, -exponent)]
    axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    for _ in range(_SWEEPS):
        turns = [(plane[:2], _rotate(entries, *plane)) for plane in _PLANES]
        for (first, second), turn in turns:
            if turn:
                _turn_axes(axes[first], axes[second], *turn)
        if not any(turn for _, turn in turns):
            break
    one, two, three = ((axis[0], axis[1], axis[2]) for axis in axes)
    first, second, third = (times_power(element, exponent) for element in entries[:3])
    return (first, second, third), (one, two, three)


def _turn_axes(one: list[float], other: list[float], cosine: float, sine: float) -> None:
    """Two axes turned as the matrix was."""
    for i in range(3):
        one[i], other[i] = cosine * one[i] - sine * other[i], sine * one[i] + cosine * other[i]


def _rotate(
    entries: list[float], first: int, second: int, off: int, with_first: int, with_second: int
) -> tuple[float, float] | None:
    """Turn the two axes so that the element between them becomes zero; None where it is as good as zero already.

    Gives the cosine and the sine of the angle.
    """
    coupling = entries[off]
    # Relative to both diagonal elements instead of the largest one: this is what keeps small
    # eigenvalues as exact as large ones (Demmel and Veselic, "Jacobi's method is more accurate than
    # QR").
    if abs(coupling) <= _EPSILON * math.sqrt(abs(entries[first])) * math.sqrt(abs(entries[second])):
        return None
    entries[off] = 0.0
    ratio = (entries[second] - entries[first]) / 2 / coupling
    tangent = math.copysign(1.0, ratio) / (abs(ratio) + math.hypot(ratio, 1.0))
    cosine = 1 / math.hypot(tangent, 1.0)
    sine = tangent * cosine
    entries[first] -= tangent * coupling
    entries[second] += tangent * coupling
    one, other = entries[with_first], entries[with_second]
    entries[with_first], entries[with_second] = cosine * one - sine * other, sine * one + cosine * other
    return cosine, sine


ELEMENTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
"""The fields of an inertia in the order of a tensor."""
ORIGIN: Vector3 = (0.0, 0.0, 0.0)
_USUAL_ELEMENTS = {name: getattr(INERTIAL.inertia, name) for name in ELEMENTS}
# A shape thinner than this part of its length has no volume: fourth powers of thinner ones lose
# digits.
_THINNEST = 1e-70


@dataclass(frozen=True, slots=True)
class Solid:
    """A mass in kg, its center in m, and the inertia in kg m^2 about that center, in the axes of the same frame."""

    mass: float
    center: Vector3
    inertia: Symmetric


NOTHING = Solid(0.0, ORIGIN, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))


def solid(shape: ShapeNode | None, density: float) -> Solid | None:
    """A shape filled with a density in kg/m^3, in the frame of the shape; None where the shape has no inside.

    Sizes that are not written are SDF's defaults.
    """
    moments_of = _SOLIDS.get(type(shape))
    if shape is None or moments_of is None:
        return None
    lengths, exponent = _in_units(sizes(shape))
    volume, center, (xx, yy, zz) = moments_of(*lengths)
    significand, of_density = math.frexp(density)
    mass = significand * volume
    of_mass = of_density + 3 * exponent
    inertia = (mass * (yy + zz), mass * (xx + zz), mass * (xx + yy), 0.0, 0.0, 0.0)
    at = (0.0, 0.0, times_power(center, exponent))
    return Solid(times_power(mass, of_mass), at, times_each(inertia, of_mass + 2 * exponent))


def _in_units(lengths: Sequence[float]) -> tuple[list[float], int]:
    """Lengths over a power of two, of about one; what is next to nothing beside the longest is nothing."""
    exponent = common_exponent(lengths)
    units = (times_power(length, -exponent) for length in lengths)
    return [unit if abs(unit) > _THINNEST else 0.0 for unit in units], exponent


_Moments = tuple[float, float, Vector3]
"""Volume in m^3, height of the center in m, and the mean of x^2, y^2 and z^2 about the center, in m^2.

A moment of inertia is the mass times two of these means: Ixx = m (<y^2> + <z^2>). The moments are those of L. D. Landau
and E. M. Lifshitz, Mechanics, section 32, problem 2.
"""


def _box(a: float, b: float, c: float) -> _Moments:
    """Sides a, b, c: Ixx = m (b^2 + c^2) / 12; problem 2 (d)."""
    return a * b * c, 0.0, (a * a / 12, b * b / 12, c * c / 12)


def _sphere(r: float) -> _Moments:
    """Radius r: I = 2/5 m r^2; problem 2 (b)."""
    return 4 / 3 * math.pi * r * r * r, 0.0, (r * r / 5, r * r / 5, r * r / 5)


def _ellipsoid(a: float, b: float, c: float) -> _Moments:
    """Semi-axes a, b, c: Ixx = m (b^2 + c^2) / 5; problem 2 (f)."""
    return 4 / 3 * math.pi * a * b * c, 0.0, (a * a / 5, b * b / 5, c * c / 5)


def _cylinder(r: float, h: float) -> _Moments:
    """Radius r, length h: Izz = m r^2 / 2, Ixx = m (r^2 + h^2 / 3) / 4; problem 2 (c)."""
    return math.pi * r * r * h, 0.0, (r * r / 4, r * r / 4, h * h / 12)


def _cone(r: float, h: float) -> _Moments:
    """Radius r, length h: Izz = 3/10 m r^2, Ixx = 3/20 m (r^2 + h^2 / 4), center h/4 above the base; problem 2 (e)."""
    return math.pi * r * r * h / 3, -h / 4, (3 / 20 * r * r, 3 / 20 * r * r, 3 / 80 * h * h)


def _capsule(r: float, h: float) -> _Moments:
    """A cylinder of radius r and length h, and the halves of a sphere with their flat sides at -h/2 and h/2.

    About its flat side a half sphere has <z^2> = r^2 / 5 as the whole has, and its center is 3/8 r above: problem 2 (b)
    and the integral of z over it. Moved by h/2, <z^2> is r^2 / 5 + 3/8 r h + h^2 / 4.
    """
    middle, ends = math.pi * r * r * h, 4 / 3 * math.pi * r * r * r
    whole = middle + ends
    if not whole:
        return 0.0, 0.0, ORIGIN
    across = (middle * r * r / 4 + ends * r * r / 5) / whole
    along = (middle * h * h / 12 + ends * (r * r / 5 + 3 / 8 * r * h + h * h / 4)) / whole
    return whole, 0.0, (across, across, along)


_SOLIDS: dict[type[Any], Callable[..., _Moments]] = {
    Box: _box,
    Sphere: _sphere,
    Ellipsoid: _ellipsoid,
    Cylinder: _cylinder,
    Cone: _cone,
    Capsule: _capsule,
}
"""What follows from the lengths of each shape."""


def tensor(inertia: Inertia | None, moment: float = 0.0) -> Symmetric:
    """Return the written inertia, with `moment` for missing moments and zero for missing products."""
    written = inertia or Inertia.unchecked()
    xx, yy, zz = (moment if value is None else value for value in (written.ixx, written.iyy, written.izz))
    return xx, yy, zz, written.ixy or 0.0, written.ixz or 0.0, written.iyz or 0.0


def with_tensor(inertia: Inertia | None, elements: Symmetric) -> Inertia:
    """Return the inertia with these elements, keeping whatever else is written in it."""
    update: dict[str, float] = dict(zip(ELEMENTS, elements, strict=True))
    return (inertia or Inertia.unchecked()).copy(**update)


def written_solid(inertial: Inertial | None, format_: Format) -> Solid:
    """Return the solid of an inertial in its own frame, by the format's defaults; in URDF, none has no mass."""
    written = inertial or Inertial.unchecked()
    mass = MASS[format_] if written.mass is None else written.mass
    return Solid(mass or 0.0, ORIGIN, tensor(written.inertia, MOMENT[format_] or 0.0))


def with_written_defaults(inertial: Inertial | None) -> Inertial:
    """The inertial of a link of SDF with the mass and the inertia written that SDF has by default."""
    if inertial is None:
        return INERTIAL
    inertia = filled(inertial.inertia or Inertia.unchecked(), _USUAL_ELEMENTS)
    return replace_fields(filled(inertial, {"mass": INERTIAL.mass}), inertia=inertia)


def placed(one: Solid, at: Transform) -> Solid:
    """A solid seen from the frame that `at` places its own in."""
    return Solid(one.mass, at.apply(one.center), turned(one.inertia, at))


def turned(inertia: Symmetric, at: Transform) -> Symmetric:
    """An inertia in the axes of the frame that `at` turns its own in: R I R^T."""
    if at.is_unturned:
        xx, yy, zz, xy, xz, yz = inertia
        return xx + 0.0, yy + 0.0, zz + 0.0, xy + 0.0, xz + 0.0, yz + 0.0
    exponent = common_exponent(inertia)
    rows = (at.rotation[0:3], at.rotation[3:6], at.rotation[6:9])
    xx, yy, zz, xy, xz, yz = times_each(inertia, -exponent)
    matrix = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    half = [[sum(row[k] * matrix[k][j] for k in range(3)) for j in range(3)] for row in rows]

    def entry(i: int, j: int) -> float:
        return sum(half[i][k] * rows[j][k] for k in range(3)) + 0.0

    found = (entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2))
    return times_each(found, exponent)


def combined(parts: Sequence[Solid]) -> Solid:
    """Several solids of one frame as one, each inertia moved to the common center by the parallel axis theorem."""
    of_mass = common_exponent(part.mass for part in parts)
    of_place = common_exponent(place for part in parts for place in part.center)
    masses = [times_power(part.mass, -of_mass) for part in parts]
    mass = safe_sum(masses)
    if not mass:
        return NOTHING
    places = [[times_power(place, -of_place) for place in part.center] for part in parts]
    center = [safe_sum(m * place[i] for m, place in zip(masses, places, strict=True)) / mass for i in range(3)]
    moved = (_steiner(m, place, center) for m, place in zip(masses, places, strict=True))
    added = [[times_power(entry, of_mass + 2 * of_place) for entry in each] for each in moved]
    about = ([a + b for a, b in zip(part.inertia, more, strict=True)] for part, more in zip(parts, added, strict=True))
    xx, yy, zz, xy, xz, yz = (safe_sum(column) for column in zip(*about, strict=True))
    x, y, z = (times_power(place, of_place) for place in center)
    return Solid(times_power(mass, of_mass), (x, y, z), (xx, yy, zz, xy, xz, yz))


def _steiner(mass: float, place: Sequence[float], center: Sequence[float]) -> Symmetric:
    """Return what the parallel axis theorem adds: m (d^2 - d d^T)."""
    x, y, z = (a - b for a, b in zip(place, center, strict=True))
    m = mass
    return m * (y * y + z * z), m * (x * x + z * z), m * (x * x + y * y), -m * x * y, -m * x * z, -m * y * z


def with_mass(one: Solid, mass: float) -> Solid:
    """Return the solid scaled to a mass, with the same shape."""
    (new, of_new), (old, of_old) = math.frexp(mass), math.frexp(one.mass)
    factor = new / old if old else 0.0
    xx, yy, zz, xy, xz, yz = (element * factor for element in times_each(one.inertia, -common_exponent(one.inertia)))
    back = of_new - of_old + common_exponent(one.inertia)
    return Solid(mass, one.center, times_each((xx, yy, zz, xy, xz, yz), back))
