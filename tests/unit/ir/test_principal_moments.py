import math
from fractions import Fraction

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from tests.exact import LARGEST, NUMBERS, eigenvalues_below, exact_sum, is_near
from tests.profile import examples
from twinform.ir.solids import Symmetric, principal_axes, principal_moments, relative_moments

MATRICES = (
    st.tuples(*[NUMBERS] * 6) | st.tuples(*[st.floats(-1, 1)] * 6) | st.tuples(*[st.integers(-2, 2).map(float)] * 6)
)


@example(matrix=(0.0, 0.0, 0.0, 0.0, 1.2e-10, 5.1e149))  # LAPACK's are off by a part in 65,000
@examples()
@given(matrix=MATRICES)
def test_moments_are_the_eigenvalues(matrix: Symmetric) -> None:
    found = principal_moments(matrix)
    assert sorted(found) == list(found)
    error = Fraction(1e-14) * max(Fraction(abs(each)) for each in matrix) + Fraction(1e-320)
    for number, moment in enumerate(found):
        exact = Fraction(moment) if math.isfinite(moment) else LARGEST * (1 if moment > 0 else -1)
        assert eigenvalues_below(matrix, exact - error) <= number or moment == -math.inf
        assert eigenvalues_below(matrix, exact + error) > number or moment == math.inf


@examples()
@given(matrix=MATRICES)
def test_relative_moments_are_those_over_a_power_of_two(matrix: Symmetric) -> None:
    found, moments = relative_moments(matrix), principal_moments(matrix)
    assert all(map(math.isfinite, (*found, sum(found))))
    power = math.frexp(max(map(abs, matrix)))[1]
    assert all(
        is_near(moment, Fraction(each) * Fraction(2) ** power, Fraction(2) ** power)
        for each, moment in zip(found, moments, strict=True)
    )


@examples()
@given(matrix=MATRICES)
def test_axes_are_unit_vectors_at_right_angles_that_the_matrix_stretches(matrix: Symmetric) -> None:
    moments, axes = principal_axes(matrix)
    exact = [[Fraction(part) for part in axis] for axis in axes]
    for i, one in enumerate(exact):
        for j, other in enumerate(exact):
            assert abs(exact_sum(a * b for a, b in zip(one, other, strict=True)) - (i == j)) < 1e-14
    xx, yy, zz, xy, xz, yz = map(Fraction, matrix)
    size = max(Fraction(abs(each)) for each in matrix)
    for moment, axis in zip(moments, exact, strict=True):
        for row, along in zip(((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)), axis, strict=True):
            pulled = exact_sum(a * b for a, b in zip(row, axis, strict=True))
            assert not math.isfinite(moment) or is_near(0.0, pulled - Fraction(moment) * along, size)


@given(st.tuples(*[st.floats(1e-6, 1)] * 3), st.tuples(*[st.floats(-0.9, 0.9)] * 3))
def test_sum_is_the_trace(diagonal: tuple[float, float, float], products: tuple[float, float, float]) -> None:
    assert sum(principal_moments((*diagonal, *products))) == pytest.approx(sum(diagonal), abs=1e-14)


def test_small_moments_beside_large_ones_are_exact() -> None:
    # D A D with D = diag(1, 1e-10, 1e-20): numpy's smallest is rounding noise of the largest
    smallest = principal_moments((2.0, 2e-20, 2e-40, 1e-10, 0.0, 1e-30))[0]
    assert smallest == pytest.approx(4 / 3 * 1e-40, rel=1e-14)


@pytest.mark.parametrize(
    ("matrix", "moments"),
    [
        ((0.0, 0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        ((3.0, 1.0, 2.0, 0.0, 0.0, 0.0), (1.0, 2.0, 3.0)),
        ((0.0, 0.0, 0.0, 1.0, 0.0, 0.0), (-1.0, 0.0, 1.0)),
        ((1e300, 1e300, 1e300, 1e300, 0.0, 0.0), (0.0, 1e300, 2e300)),
    ],
)
def test_special_matrices(matrix: Symmetric, moments: tuple[float, float, float]) -> None:
    assert principal_moments(matrix) == pytest.approx(moments, rel=1e-15)
