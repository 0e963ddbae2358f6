import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.ir.principal_moments import Symmetric, principal_moments

ELEMENTS = st.floats(-1e150, 1e150)


def full(matrix: Symmetric) -> "np.ndarray[tuple[int, int], np.dtype[np.float64]]":
    xx, yy, zz, xy, xz, yz = matrix
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


@given(
    st.tuples(*[ELEMENTS] * 6) | st.tuples(*[st.floats(-1, 1)] * 6) | st.tuples(*[st.integers(-2, 2).map(float)] * 6)
)
def test_moments_are_the_eigenvalues_that_numpy_finds(matrix: Symmetric) -> None:
    expected = np.linalg.eigvalsh(full(matrix))
    scale = float(np.abs(expected).max())
    assert principal_moments(matrix) == pytest.approx(expected, rel=0, abs=1e-14 * scale + 1e-320)


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
