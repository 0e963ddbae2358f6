"""The inertia of shapes against a sum over small pieces, which knows none of the formulas."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.ir import Box, Capsule, Cone, Cylinder, Ellipsoid, Mesh, Plane, Pose, Sphere
from twinform.ir.solids import Solid, combined, placed, solid, with_mass
from twinform.ir.transform import Transform

pytestmark = pytest.mark.slow

Points = Any
Inside = Callable[[Points, Points, Points], Points]

SHAPES: list[tuple[Any, tuple[float, float, float], Inside]] = [
    (Box(size=(1.0, 2.0, 3.0)), (0.5, 1.0, 1.5), lambda x, y, z: x == x),
    (Sphere(radius=0.7), (0.7, 0.7, 0.7), lambda x, y, z: x * x + y * y + z * z <= 0.49),
    (Ellipsoid(radii=(1.0, 0.5, 0.8)), (1, 0.5, 0.8), lambda x, y, z: x * x + 4 * y * y + z * z / 0.64 <= 1),
    (Cylinder(radius=0.5, length=2.0), (0.5, 0.5, 1.0), lambda x, y, z: x * x + y * y <= 0.25),
    (Cone(radius=0.5, length=2.0), (0.5, 0.5, 1.0), lambda x, y, z: np.hypot(x, y) <= 0.25 * (1 - z)),
    (
        Capsule(radius=0.5, length=2.0),
        (0.5, 0.5, 1.5),
        lambda x, y, z: x * x + y * y + np.maximum(np.abs(z) - 1, 0) ** 2 <= 0.25,
    ),
]
_STEPS = 160


def summed(extent: tuple[float, float, float], inside: Inside, density: float) -> Solid:
    """The same from the midpoints of a grid of boxes."""
    axes = [(np.arange(_STEPS) + 0.5) / _STEPS * 2 * half - half for half in extent]
    x, y, z = np.meshgrid(*axes, indexing="ij")
    weight = inside(x, y, z) * density * math.prod(2 * half / _STEPS for half in extent)
    mass = float(weight.sum())
    cx, cy, cz = (float((weight * axis).sum() / mass) for axis in (x, y, z))
    dx, dy, dz = x - cx, y - cy, z - cz
    products = (dy**2 + dz**2, dx**2 + dz**2, dx**2 + dy**2, -dx * dy, -dx * dz, -dy * dz)
    xx, yy, zz, xy, xz, yz = (float((weight * product).sum()) for product in products)
    return Solid(mass, (cx, cy, cz), (xx, yy, zz, xy, xz, yz))


def numbers(one: Solid) -> list[float]:
    return [one.mass, *one.center, *one.inertia]


@pytest.mark.parametrize(("shape", "extent", "inside"), SHAPES, ids=lambda value: getattr(value, "kind", ""))
def test_a_shape_weighs_and_turns_as_its_pieces_do(shape: Any, extent: tuple[float, float, float], inside: Inside):
    found = solid(shape, 500.0)
    assert found
    expected = summed(extent, inside, 500.0)
    assert numbers(found) == pytest.approx(numbers(expected), rel=2e-3, abs=2e-3 * found.mass)


@pytest.mark.parametrize("kind", [Box, Sphere, Ellipsoid, Cylinder, Cone, Capsule])
def test_a_size_that_is_not_written_is_the_default(kind: Any):
    sizes: dict[Any, dict[str, Any]] = {
        Box: {"size": (1.0, 1.0, 1.0)},
        Ellipsoid: {"radii": (1.0, 1.0, 1.0)},
        Sphere: {"radius": 1.0},
        Capsule: {"radius": 0.5, "length": 1.0},
    }
    assert solid(kind(), 1.0) == solid(kind(**sizes.get(kind, {"radius": 1.0, "length": 1.0})), 1.0)


@pytest.mark.parametrize("shape", [Plane(), Mesh(uri="a.stl"), None])
def test_what_has_no_inside_has_no_mass(shape: Any):
    assert solid(shape, 1000.0) is None


def test_a_sphere_without_size_is_nothing():
    nothing = solid(Capsule(radius=0.0, length=0.0), 1000.0)
    assert nothing
    assert nothing == Solid(0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert combined([nothing]) == nothing


ANGLES = st.floats(-3, 3)
PLACES = st.floats(-5, 5)
POSES = st.builds(Pose, xyz=st.tuples(PLACES, PLACES, PLACES), rpy=st.tuples(ANGLES, ANGLES, ANGLES)).map(
    Transform.from_pose
)


@given(POSES, st.floats(0.1, 3), st.floats(0.1, 3))
def test_two_halves_of_a_box_are_the_box_wherever_they_are(at: Transform, width: float, height: float):
    half = solid(Box(size=(1.0, width, height)), 800.0)
    whole = solid(Box(size=(2.0, width, height)), 800.0)
    assert half
    assert whole
    sides = [at.compose(Transform((x, 0.0, 0.0))) for x in (-0.5, 0.5)]
    together = combined([placed(half, side) for side in sides])
    expected = placed(whole, at)
    assert numbers(together) == pytest.approx(numbers(expected), rel=1e-9, abs=1e-9 * expected.mass * 100)


@given(POSES)
def test_turning_keeps_the_principal_moments(at: Transform):
    one = solid(Box(size=(1.0, 2.0, 3.0)), 10.0)
    assert one
    xx, yy, zz, xy, xz, yz = placed(one, at).inertia
    moments = np.linalg.eigvalsh(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
    assert sorted(moments) == pytest.approx(sorted(one.inertia[:3]))


def test_another_mass_scales_the_inertia():
    one = solid(Sphere(radius=1.0), 1000.0)
    assert one
    heavy = with_mass(one, 2 * one.mass)
    assert heavy.inertia[0] == pytest.approx(2 * one.inertia[0])
    assert heavy.center == one.center
