"""Solids of every size and mass that doubles can say, against exact arithmetic."""

import math
from collections.abc import Callable
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.exact import LEAST, MAGNITUDES, NUMBERS, exact_sum, is_near
from tests.profile import examples
from twinform.ir import Box, Capsule, Cone, Cylinder, Ellipsoid, Pose, Sphere
from twinform.ir.geometry import ShapeNode
from twinform.ir.solids import Solid, combined, placed, solid, with_mass
from twinform.ir.transform import Transform

PI = Fraction(math.pi)
Exact = tuple[Fraction, Fraction, Fraction, Fraction]
"""Volume, and the moments about x, y and z over the density."""

Lengths = tuple[float, float, float]

PLACES = st.tuples(NUMBERS, NUMBERS, NUMBERS)
POSITIVE = st.tuples(*[MAGNITUDES] * 3)
SOLIDS = st.builds(Solid, MAGNITUDES, PLACES, st.tuples(*[NUMBERS] * 6))


def box(a: Fraction, b: Fraction, c: Fraction) -> Exact:
    volume = a * b * c
    return volume, volume * (b * b + c * c) / 12, volume * (a * a + c * c) / 12, volume * (a * a + b * b) / 12


def ellipsoid(a: Fraction, b: Fraction, c: Fraction) -> Exact:
    volume = PI * 4 / 3 * a * b * c
    return volume, volume * (b * b + c * c) / 5, volume * (a * a + c * c) / 5, volume * (a * a + b * b) / 5


def cylinder(r: Fraction, h: Fraction) -> Exact:
    volume = PI * r * r * h
    across = volume * (3 * r * r + h * h) / 12
    return volume, across, across, volume * r * r / 2


def cone(r: Fraction, h: Fraction) -> Exact:
    volume = PI * r * r * h / 3
    across = volume * 3 * (4 * r * r + h * h) / 80
    return volume, across, across, volume * 3 * r * r / 10


def capsule(r: Fraction, h: Fraction) -> Exact:
    middle, ends = PI * r * r * h, PI * 4 / 3 * r * r * r
    across = middle * (3 * r * r + h * h) / 12 + ends * (2 * r * r / 5 + h * h / 4 + 3 * h * r / 8)
    return middle + ends, across, across, middle * r * r / 2 + ends * 2 * r * r / 5


def sphere(r: Fraction) -> Exact:
    return ellipsoid(r, r, r)


SHAPES: dict[str, tuple[Callable[[Lengths], ShapeNode], Callable[..., Exact], int]] = {
    "box": (lambda each: Box(size=each), box, 3),
    "ellipsoid": (lambda each: Ellipsoid(radii=each), ellipsoid, 3),
    "sphere": (lambda each: Sphere(radius=each[0]), sphere, 1),
    "cylinder": (lambda each: Cylinder(radius=each[0], length=each[1]), cylinder, 2),
    "cone": (lambda each: Cone(radius=each[0], length=each[1]), cone, 2),
    "capsule": (lambda each: Capsule(radius=each[0], length=each[1]), capsule, 2),
}
"""Each shape, its formula, and how many lengths it has."""


@pytest.mark.parametrize("kind", SHAPES)
@examples()
@given(lengths=POSITIVE, density=MAGNITUDES)
def test_a_shape_has_the_mass_and_moments_of_its_formula_or_fills_nothing(kind: str, lengths: Lengths, density: float):
    shape, formula, count = SHAPES[kind]
    used = lengths[:count]
    found = solid(shape(lengths), density)
    assert found
    volume, *moments = formula(*map(Fraction, used))
    if found.mass == 0:  # too thin, or lighter than any double
        assert min(used) < 1e-69 * max(used) or volume * Fraction(density) < LEAST
        return
    exact = [each * Fraction(density) for each in (volume, *moments)]
    for each, right in zip((found.mass, *found.inertia[:3]), exact, strict=True):
        assert is_near(each, right, right)


@examples()
@given(one=SOLIDS, quaternion=st.tuples(*[st.floats(-1, 1)] * 4))
def test_turned_it_is_the_product_of_the_matrices(one: Solid, quaternion: tuple[float, float, float, float]):
    at = Transform.from_pose(Pose(quat_xyzw=quaternion))
    xx, yy, zz, xy, xz, yz = map(Fraction, one.inertia)
    matrix = ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))
    turn = [[Fraction(each) for each in at.rotation[3 * row : 3 * row + 3]] for row in range(3)]
    size = max(map(abs, map(Fraction, one.inertia)))
    for each, (i, j) in zip(placed(one, at).inertia, ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)), strict=True):
        exact = exact_sum(turn[i][k] * matrix[k][m] * turn[j][m] for k in range(3) for m in range(3))
        assert is_near(each, exact, size)


@examples()
@given(parts=st.lists(SOLIDS, min_size=1, max_size=4))
def test_together_they_have_the_mass_the_center_and_the_inertia_of_all(parts: list[Solid]):
    found = combined(parts)
    masses = [Fraction(part.mass) for part in parts]
    places = [[Fraction(place) for place in part.center] for part in parts]
    mass = exact_sum(masses)
    assert is_near(found.mass, mass, mass)
    center = [exact_sum(m * place[i] for m, place in zip(masses, places, strict=True)) / mass for i in range(3)]
    reach = max((abs(each) for place in places for each in place), default=Fraction(0))
    assert all(is_near(each, exact, reach) for each, exact in zip(found.center, center, strict=True))
    size = mass * reach * reach + max(abs(Fraction(each)) for part in parts for each in part.inertia)
    away = [[a - b for a, b in zip(place, center, strict=True)] for place in places]
    for number, (i, j) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))):
        steiner = (
            m * ((i == j) * exact_sum(each * each for each in d) - d[i] * d[j])
            for m, d in zip(masses, away, strict=True)
        )
        exact = exact_sum(Fraction(part.inertia[number]) for part in parts) + exact_sum(steiner)
        assert size > Fraction(1e307) or is_near(found.inertia[number], exact, size)


@examples()
@given(one=SOLIDS, mass=MAGNITUDES)
def test_another_mass_scales_the_inertia_by_the_ratio(one: Solid, mass: float):
    for each, before in zip(with_mass(one, mass).inertia, one.inertia, strict=True):
        exact = Fraction(before) / Fraction(one.mass) * Fraction(mass)
        size = max(abs(Fraction(element)) for element in one.inertia) / Fraction(one.mass) * Fraction(mass)
        assert is_near(each, exact, max(abs(exact), size * Fraction(1e-290)))
