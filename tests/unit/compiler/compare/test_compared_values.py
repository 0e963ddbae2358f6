import math

import pytest

from twinform.compiler.compare.compared_values import (
    Flag,
    Numbers,
    Point,
    PoseValue,
    Tensor,
    Text,
    UnitVector,
    Value,
    gaps,
)
from twinform.ir import Pose
from twinform.ir.transform import Transform

_QUARTER = Transform.from_pose(Pose(rpy=(0, 0, math.pi / 2)))
_SIXTH = Transform.from_pose(Pose(xyz=(0, 0, 1), rpy=(math.pi / 6, 0, 0)))


@pytest.mark.parametrize(
    ("one", "other", "absolute", "relative"),
    [
        (Numbers((2.0,)), Numbers((3.0,)), 1.0, 1 / 3),
        (Numbers((1.0, 2.0)), Numbers((1.0, 4.0)), 2.0, 0.5),
        (Numbers((1.0,)), Numbers((math.inf,)), math.inf, None),
        (Text("a"), Text("b"), math.inf, None),
        (Flag(True), Flag(False), math.inf, None),
        (Point((0.0, 0.0, 0.0)), Point((0.0, 3.0, 4.0)), 5.0, 1.0),
        (UnitVector((1.0, 0.0, 0.0)), UnitVector((0.0, 1.0, 0.0)), math.pi / 2, None),
        (Tensor((1, 1, 1, 0, 0, 0)), Tensor((1, 1, 1, 0, 0.5, 0)), 0.5, 0.5),
    ],
)
def test_how_far_two_values_are_apart(one: Value, other: Value, absolute: float, relative: float | None):
    (gap,) = gaps(one, other)
    assert gap.absolute == pytest.approx(absolute)
    assert gap.relative == (None if relative is None else pytest.approx(relative))


def test_two_places_differ_in_position_and_in_rotation():
    position, rotation = gaps(PoseValue(Transform()), PoseValue(_SIXTH))
    assert (position.aspect, position.absolute, position.unit) == ("position", 1.0, "m")
    assert (rotation.aspect, rotation.absolute, rotation.unit) == ("rotation", pytest.approx(math.pi / 6), "rad")


def test_numbers_that_are_too_small_for_others_are_one():
    assert not any(gaps(Numbers((1e-310,)), Numbers((2.3e-308,))))
    assert any(gaps(Numbers((0.0,)), Numbers((1e-14,))))


@pytest.mark.parametrize("value", [Numbers((math.nan,)), Numbers((math.inf, 1.0)), Text("x"), PoseValue(_SIXTH)])
def test_nothing_is_apart_from_itself(value: Value):
    assert not any(gap.exceeds(0.0) for gap in gaps(value, value))


def test_what_is_in_space_is_seen_from_a_frame():
    (x, y, z) = Point((1.0, 0.0, 0.0)).seen_from(_QUARTER).xyz
    assert (x, y, z) == pytest.approx((0.0, -1.0, 0.0))
    assert Tensor((1, 2, 3, 0, 0, 0)).seen_from(_QUARTER).moments == pytest.approx((2, 1, 3, 0, 0, 0))
    assert Numbers((1.0,)).seen_from(_QUARTER) == Numbers((1.0,))


def test_a_small_value_has_a_small_tolerance_and_a_place_that_of_a_metre():
    (mass,) = gaps(Numbers((1e-6,)), Numbers((1.001e-6,)))
    assert mass.exceeds(1e-9)
    (away,) = gaps(Point((0.0, 0.0, 0.0)), Point((1e-12, 0.0, 0.0)))
    assert not away.exceeds(1e-9)
