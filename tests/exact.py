"""Exact arithmetic as the judge of closed forms: fractions neither round nor overflow."""

import math
import sys
from collections.abc import Iterable, Sequence
from fractions import Fraction
from itertools import pairwise

from hypothesis import strategies as st

Symmetric = tuple[float, float, float, float, float, float]
LARGEST, LEAST = Fraction(sys.float_info.max), Fraction(sys.float_info.min)

MAGNITUDES = st.builds(math.ldexp, st.floats(0.5, 1, exclude_max=True), st.integers(-1073, 1024)) | st.sampled_from(
    [5e-324, 1e-310, 1e-300, 1e-154, 1e-10, 1.0, 1e150, 1e300, sys.float_info.max]
)
"""Positive doubles of every size, as likely small as large, subnormal ones among them."""
NUMBERS = st.builds(math.copysign, st.just(0.0) | MAGNITUDES, st.sampled_from([1.0, -1.0]))


def negative_eigenvalues(matrix: Sequence[Fraction]) -> int:
    """How many eigenvalues of xx, yy, zz, xy, xz, yz are below zero: Descartes' rule, as all of them are real."""
    xx, yy, zz, xy, xz, yz = matrix
    trace = xx + yy + zz
    minors = xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz
    determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    signs = [each > 0 for each in (Fraction(1), trace, minors, determinant) if each]
    return sum(one != other for one, other in pairwise(signs))


def eigenvalues_below(matrix: Symmetric, bound: Fraction) -> int:
    """How many eigenvalues are below a number."""
    exact = [Fraction(each) for each in matrix]
    return negative_eigenvalues([*(each - bound for each in exact[:3]), *exact[3:]])


def exact_sum(numbers: Iterable[Fraction]) -> Fraction:
    """Their sum, which is a fraction also of none."""
    return sum(numbers, Fraction(0))


def is_near(found: float, exact: Fraction, size: Fraction, part: float = 1e-14) -> bool:
    """Whether a result is the exact one but for a part of `size`; beyond all doubles it has to be infinite."""
    error = Fraction(part) * size + LEAST
    if not math.isfinite(found):
        return not math.isnan(found) and abs(exact) >= LARGEST - error and (exact > 0) == (found > 0)
    return abs(Fraction(found) - exact) <= error
