"""The nearest possible inertia, judged by the property that defines a projection, and by numpy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from twinform.ir.solids import Symmetric, principal_axes
from twinform.ir.verify.verify_bodies import inertia_matrix
from twinform.passes import parse_pipeline
from twinform.passes.inertia.physical_consistency import (
    is_clearly_possible,
    nearest_moments,
    nearest_possible,
    second_moments,
)

NUMBERS = st.floats(-10, 10)
MATRICES = st.tuples(*[NUMBERS] * 6)
FLOORS = st.floats(0, 0.5)


def matrix(elements: Symmetric) -> np.ndarray:
    xx, yy, zz, xy, xz, yz = elements
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def spread(inertia: np.ndarray) -> np.ndarray:
    """The second moments of mass."""
    return np.trace(inertia) / 2 * np.eye(3) - inertia


@given(MATRICES, FLOORS)
def test_what_comes_out_is_possible(elements: Symmetric, floor: float) -> None:
    found = matrix(nearest_possible(elements, floor))
    assert np.linalg.eigvalsh(spread(found)).min() >= floor - 1e-13


@given(MATRICES, FLOORS, MATRICES)
def test_nothing_possible_is_nearer(elements: Symmetric, floor: float, other: Symmetric) -> None:
    # p is the nearest point of a convex set to x where (x - p) . (y - p) <= 0 for every y of the set
    x, p = matrix(elements), matrix(nearest_possible(elements, floor))
    factor = matrix(other)
    y = np.trace(factor @ factor) * np.eye(3) - factor @ factor + 2 * floor * np.eye(3)  # any possible inertia
    assert ((x - p) * (y - p)).sum() <= 1e-12 * max(1, np.abs(x).max()) * max(1, np.abs(y).max())


@given(MATRICES, FLOORS)
def test_what_is_possible_stays(elements: Symmetric, floor: float) -> None:
    once = nearest_possible(elements, floor)
    assert nearest_possible(once, floor) == pytest.approx(once, abs=1e-13)


@given(MATRICES)
def test_axes_and_moments_are_those_of_numpy(elements: Symmetric) -> None:
    moments, axes = principal_axes(elements)
    turned = np.array(axes)
    assert np.allclose(turned @ turned.T, np.eye(3), atol=1e-13)
    assert np.allclose(turned.T @ np.diag(moments) @ turned, matrix(elements), atol=1e-12)


@pytest.mark.parametrize(
    ("moments", "expected"),
    [
        ((1.0, 0.1, 0.1), (1 - 0.8 / 3, 0.1 + 0.8 / 3, 0.1 + 0.8 / 3)),
        ((1.0, 1.0, -1.0), (1.0, 1.0, 0.0)),
        ((1.0, 0.1, -2.0), (0.55, 0.55, 0.0)),
        ((-1.0, -1.0, -1.0), (0.0, 0.0, 0.0)),
        ((3.0, 2.0, 1.0), (3.0, 2.0, 1.0)),
        ((3.0, 2.0, 0.5), (3.0 - 0.5 / 3, 2.0 + 0.5 / 3, 0.5 + 0.5 / 3)),
    ],
)
def test_moments_by_hand(moments: tuple[float, float, float], expected: tuple[float, float, float]) -> None:
    assert nearest_moments(moments, 0.0) == pytest.approx(expected)
    assert min(second_moments(nearest_moments(moments, 0.01))) >= 0.01 - 1e-15


@pytest.mark.parametrize(
    ("elements", "is_clear"),
    [
        ((0.25, 0.5, 0.75, 0.0, 0.0, 0.0), True),
        ((0.25, 0.5, 0.7500000000000002, 0.0, 0.0, 0.0), False),
        ((9e-6, 1e-6, 1e-5, -1e-6, 0.0, 0.0), False),
        ((9e-6, 1e-6, 0.999e-5, -1e-6, 0.0, 0.0), True),
        ((1.5e-8, 1.5e-8, 3e-8, 1.5e-8, 0.0, 0.0), False),
        ((0.0, 1.0, 1.0, 0.0, 0.0, 0.0), False),
    ],
)
def test_what_has_to_be_turned_has_to_be_clear(elements: Symmetric, is_clear: bool) -> None:
    assert is_clearly_possible(elements) == is_clear


@given(MATRICES, FLOORS.filter(lambda floor: floor > 1e-3))
def test_what_comes_out_is_clear(elements: Symmetric, floor: float) -> None:
    assert is_clearly_possible(nearest_possible(elements, floor))


@given(MATRICES, st.floats(1e-15, 1))
def test_no_moment_is_below_the_least(elements: Symmetric, least: float) -> None:
    xx, yy, zz, xy, xz, yz = elements
    inertia = f'ixx="{xx!r}" iyy="{yy!r}" izz="{zz!r}" ixy="{xy!r}" ixz="{xz!r}" iyz="{yz!r}"'
    text = f'<robot name="r"><link name="a"><inertial><mass value="1"/><inertia {inertia}/></inertial></link></robot>'
    made = twinform.convert(text.encode(), to="urdf", passes=f"balance-inertia{{least={least!r}}}")
    (link,) = made.document.models[0].links
    assert link.inertial is not None
    found = inertia_matrix(link.inertial.inertia, 0.0)
    assert found is not None
    assert np.linalg.eigvalsh(matrix(found)).min() >= least * (1 - 1e-9) - 1e-14


@pytest.mark.parametrize("options", ["thickness=-1", "margin=1", "thickness=inf", "least=-1"])
def test_options_that_mean_nothing_are_refused(options: str) -> None:
    with pytest.raises(ValueError, match="balance-inertia"):
        parse_pipeline(f"balance-inertia{{{options}}}")
