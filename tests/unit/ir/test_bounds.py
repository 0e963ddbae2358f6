"""The boxes around shapes; the numbers can be read off the shapes."""

import math

import pytest

from twinform.ir import Box, Capsule, Cone, Cylinder, Ellipsoid, Plane, Pose, Sphere
from twinform.ir.bounds import Bounds, bounds, placed_bounds, united
from twinform.ir.geometry import ShapeNode
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform


@pytest.mark.parametrize(
    ("shape", "halves"),
    [
        (Box(), (0.5, 0.5, 0.5)),
        (Box(size=(2, 4, 6)), (1, 2, 3)),
        (Sphere(), (1, 1, 1)),
        (Sphere(radius=3), (3, 3, 3)),
        (Ellipsoid(), (1, 1, 1)),
        (Ellipsoid(radii=(1, 2, 3)), (1, 2, 3)),
        (Cylinder(), (1, 1, 0.5)),
        (Cylinder(radius=2, length=6), (2, 2, 3)),
        (Cone(), (1, 1, 0.5)),
        (Cone(radius=2, length=6), (2, 2, 3)),
        (Capsule(), (0.5, 0.5, 1)),
        (Capsule(radius=2, length=6), (2, 2, 5)),
        (Box(size=(-2, 4, 6)), (1, 2, 3)),
        (Sphere(radius=0), (0, 0, 0)),
    ],
    ids=repr,
)
def test_the_box_of_a_shape_is_about_its_middle(shape: ShapeNode, halves: Vector3) -> None:
    x, y, z = halves
    assert bounds(shape) == Bounds((-x, -y, -z), halves)


@pytest.mark.parametrize("shape", [None, Plane()])
def test_what_has_no_ends_has_no_box(shape: ShapeNode | None) -> None:
    assert bounds(shape) is None


BOX = Bounds((1, 2, 3), (3, 8, 13))


def test_the_size_is_what_lies_between_the_corners() -> None:
    assert BOX.size == (2, 6, 10)


@pytest.mark.parametrize(
    ("point", "distance"),
    [
        ((2, 5, 8), -1),
        ((1, 5, 8), 0),
        ((0.5, 5, 8), 0.5),
        ((3.25, 5, 8), 0.25),
        ((2, 0, 8), 2),
        ((2, 5, 20), 7),
        ((0, -2, 14), 4),
    ],
)
def test_the_distance_is_that_of_the_farthest_axis(point: Vector3, distance: float) -> None:
    assert BOX.distance(point) == distance


def test_a_box_that_is_moved_has_its_size() -> None:
    assert placed_bounds(BOX, Transform.from_pose(Pose(xyz=(10, 20, 30)))) == Bounds((11, 22, 33), (13, 28, 43))


def test_a_box_that_is_turned_by_a_quarter_has_its_sides_exchanged() -> None:
    turned = placed_bounds(BOX, Transform.from_pose(Pose(rpy=(0, 0, math.pi / 2))))
    assert turned.least == pytest.approx((-8, 1, 3))
    assert turned.greatest == pytest.approx((-2, 3, 13))


def test_a_box_that_is_turned_a_little_grows() -> None:
    turned = placed_bounds(Bounds((-1, -1, -1), (1, 1, 1)), Transform.from_pose(Pose(rpy=(math.pi / 4, 0, 0))))
    assert turned.size == pytest.approx((2, 2 * math.sqrt(2), 2 * math.sqrt(2)))


def test_the_box_around_several_has_the_outmost_sides() -> None:
    assert united([Bounds((0, 5, -1), (1, 9, 1)), Bounds((-2, 6, 0), (0, 7, 4))]) == Bounds((-2, 5, -1), (1, 9, 4))
    assert united([BOX]) == BOX
    assert united([]) is None
