"""Whether a body can have a mass and an inertia."""

import math

from twinform.ir import Format, Inertial
from twinform.ir.defaults import MOMENT
from twinform.ir.principal_moments import relative_moments
from twinform.ir.verify.inertia import inertia_matrix

ROUNDING = 1e-15
"""What ten operations on doubles leave of a moment that is exactly zero, as a part of the trace."""
DIGITS = 1e-6
"""What files lose by cutting digits off, as a part of the trace."""


def has_mass(inertial: Inertial | None) -> bool:
    """Whether a mass is written that a body can have."""
    return inertial is not None and inertial.mass is not None and 0 < inertial.mass < math.inf


def is_possible(inertial: Inertial, format_: Format) -> bool:
    """Whether mass and moments are those of a body, but for the digits that files cut off."""
    matrix = inertia_matrix(inertial.inertia, MOMENT[format_])
    if not has_mass(inertial) or matrix is None or not all(map(math.isfinite, matrix)):
        return False
    smallest, middle, largest = relative_moments(matrix)
    trace = abs(smallest + middle + largest)
    return smallest > ROUNDING * trace and largest - smallest - middle <= DIGITS * trace
