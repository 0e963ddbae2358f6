"""Physical consistency of inertias: whether a body can have an inertia, and the nearest one that a body can have.

An inertia I belongs to a body if its second moments of mass S = tr(I)/2 - I are positive definite, which implies both
the triangle inequality and positive moments: P. Wensing, S. Kim and J.-J. Slotine 2018, "Linear matrix inequalities for
physically-consistent inertial parameter identification", IEEE Robotics and Automation Letters 3(1). These inertias are
a convex cone that depends only on the principal moments, so the nearest one (by the sum of the squares of all nine
elements) has the same axes, and its moments are the nearest three numbers in a cone with three sides: A. Lewis 1996,
"Convex analysis on the Hermitian matrices", SIAM Journal on Optimization 6(1).
"""

import math

from twinform.ir import Format, Inertial
from twinform.ir.defaults import MOMENT
from twinform.ir.solids import Axes, Symmetric, principal_axes, relative_moments, times_each
from twinform.ir.transform import common_exponent
from twinform.ir.verify.verify_bodies import inertia_matrix

ROUNDING = 1e-15
"""The error of a moment that is exactly zero after ten operations on doubles, as a fraction of the trace."""
FOUND_AXES = 1e-8
"""The error of libsdformat when it computes principal axes, as a fraction of the largest moment: of two equal roots of
the cubic equation half of the digits are lost. Other programs lose less."""
DIGITS = 1e-6
"""The error of moments in files that have few digits, as a fraction of the trace."""


def has_mass(inertial: Inertial | None) -> bool:
    """Whether a mass is written that a body can have."""
    return inertial is not None and inertial.mass is not None and 0 < inertial.mass < math.inf


def is_possible(inertial: Inertial, format_: Format) -> bool:
    """Whether a body can have this mass and inertia, if the few digits of files are taken into account."""
    matrix = inertia_matrix(inertial.inertia, MOMENT[format_])
    if not has_mass(inertial) or matrix is None or not all(map(math.isfinite, matrix)):
        return False
    smallest, middle, largest = relative_moments(matrix)
    trace = abs(smallest + middle + largest)
    return smallest > ROUNDING * trace and largest - smallest - middle <= DIGITS * trace


def clearances(matrix: Symmetric) -> tuple[float, float]:
    """The smallest principal moment, and the sum of the two smaller ones minus the largest, relative to the largest.

    If one of them is negative, no body has the inertia. All elements have to be finite.
    """
    smallest, middle, largest = relative_moments(matrix)
    size = abs(largest) or 1.0
    return smallest / size, (smallest + middle - largest) / size


def rounding_loss(matrix: Symmetric) -> float:
    """By how much programs may err in the clearances: nothing if they need not compute the axes."""
    return FOUND_AXES if any(matrix[3:]) else 0.0


def is_clearly_possible(matrix: Symmetric) -> bool:
    """Whether a body can have this inertia, and every engine agrees."""
    smallest, gap = clearances(matrix)
    lost = rounding_loss(matrix)
    return smallest > lost and gap >= lost


def is_doubtful(matrix: Symmetric) -> bool:
    """Whether rounding decides if an engine finds that a body can have this inertia."""
    return any(matrix[3:]) and abs(min(clearances(matrix))) <= rounding_loss(matrix)


Moments = tuple[float, float, float]


def nearest_possible(matrix: Symmetric, floor: float) -> Symmetric:
    """The nearest inertia whose second moments of mass are all at least `floor`, which is finite, in kg m^2.

    Elements that overflow are infinite.
    """
    exponent = common_exponent((*matrix, floor))
    moments, axes = principal_axes(times_each(matrix, -exponent))
    return times_each(_compose(nearest_moments(moments, math.ldexp(floor, -exponent)), axes), exponent)


def nearest_moments(moments: Moments, floor: float) -> Moments:
    """The principal moments of the nearest inertia, in the same order.

    A body with second moments f along all axes has the moments 2f: subtracting these leaves a cone with its tip at
    zero.
    """
    order = sorted(range(3), key=lambda axis: moments[axis])
    smallest, middle, largest = (moments[axis] - 2 * floor for axis in order)
    found = [0.0, 0.0, 0.0]
    for axis, value in zip(order, _project_onto_cone(smallest, middle, largest), strict=True):
        found[axis] = value + 2 * floor
    return found[0], found[1], found[2]


def _project_onto_cone(smallest: float, middle: float, largest: float) -> Moments:
    """The nearest to three sorted moments of which none is greater than the sum of the others."""
    # Three cases in closed form. A test holds the result to the inequality that defines a
    # projection onto a convex set.
    excess = largest - smallest - middle
    if excess <= 0 <= smallest:
        return smallest, middle, largest
    if smallest + excess / 3 >= 0 < excess:  # onto the side where the largest is the sum of the others
        low = smallest + excess / 3
        high = max(middle + excess / 3, low)  # which rounding can deny
        return low, high, low + high
    edge = max((middle + largest) / 2, 0.0)  # onto the edge where the smallest is zero: a rod without thickness
    return 0.0, edge, edge


def second_moments(moments: Moments) -> Moments:
    """The second moments of mass along the principal axes, in kg m^2: how far the mass spreads along each of them."""
    half = sum(moments) / 2
    return half - moments[0], half - moments[1], half - moments[2]


def distance(one: Symmetric, other: Symmetric) -> float:
    """The root of the sum of the squared differences of all nine elements, in kg m^2."""
    gaps = [a - b for a, b in zip(one, other, strict=True)]
    return math.hypot(*gaps, *gaps[3:])


def _compose(moments: Moments, axes: Axes) -> Symmetric:
    """The matrix with these moments about these axes."""

    def entry(i: int, j: int) -> float:
        return math.fsum(moment * axis[i] * axis[j] for moment, axis in zip(moments, axes, strict=True)) + 0.0

    return entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)
