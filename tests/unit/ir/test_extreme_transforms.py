"""Poses of every size that doubles can say, against exact arithmetic."""

import math
from fractions import Fraction

from hypothesis import example, given
from hypothesis import strategies as st

from tests.exact import NUMBERS, exact_sum, is_near
from tests.profile import examples
from twinform.ir import Pose, Quaternion, Vector3
from twinform.ir.transform import Matrix3, Transform

VECTORS = st.tuples(NUMBERS, NUMBERS, NUMBERS)
QUATERNIONS = st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS)


def exact_rotation(quaternion: Quaternion) -> list[Fraction]:
    """The rotation of a quaternion of any length but zero."""
    x, y, z, w = map(Fraction, quaternion)
    two = 2 / (x * x + y * y + z * z + w * w)
    return [
        1 - two * (y * y + z * z), two * (x * y - z * w), two * (x * z + y * w),
        two * (x * y + z * w), 1 - two * (x * x + z * z), two * (y * z - x * w),
        two * (x * z - y * w), two * (y * z + x * w), 1 - two * (x * x + y * y),
    ]  # fmt: skip


def are_near(one: Matrix3, other: Matrix3) -> bool:
    return all(abs(a - b) < 4e-15 for a, b in zip(one, other, strict=True))


@example(quaternion=(5e-324, 0.0, 0.0, 5e-324))
@example(quaternion=(1.7e308, 1.7e308, 0.0, 1.7e308))
@examples()
@given(quaternion=QUATERNIONS.filter(any))
def test_a_quaternion_of_any_length_is_its_rotation(quaternion: Quaternion):
    turned = Transform.from_pose(Pose(quat_xyzw=quaternion))
    exact = exact_rotation(quaternion)
    assert all(is_near(each, right, Fraction(1), 2e-15) for each, right in zip(turned.rotation, exact, strict=True))
    again = Transform.from_pose(Pose(quat_xyzw=turned.quaternion()))
    assert are_near(again.rotation, turned.rotation)
    assert are_near(Transform.from_pose(Pose(rpy=turned.rpy())).rotation, turned.rotation)


@examples()
@given(rpy=VECTORS, degrees=st.booleans())
def test_angles_of_any_size_turn_and_come_back(rpy: Vector3, degrees: bool):
    turned = Transform.from_pose(Pose(rpy=rpy, degrees=degrees))
    r = turned.rotation
    for i in range(3):
        for j in range(3):
            assert abs(math.fsum(r[3 * i + k] * r[3 * j + k] for k in range(3)) - (i == j)) < 2e-15
    assert are_near(Transform.from_pose(Pose(rpy=turned.rpy())).rotation, r)
    assert are_near(Transform.from_pose(Pose(quat_xyzw=turned.quaternion())).rotation, r)


@examples()
@given(one=VECTORS, other=VECTORS, quaternion=QUATERNIONS)
def test_composing_moves_points_exactly_or_out_of_all_numbers(one: Vector3, other: Vector3, quaternion: Quaternion):
    at = Transform.from_pose(Pose(xyz=one, quat_xyzw=quaternion))
    size = max(Fraction(abs(each)) for each in (*one, *other))
    found = at.compose(Transform(other)).translation
    for row, each in enumerate(found):
        turned = exact_sum(Fraction(at.rotation[3 * row + k]) * Fraction(other[k]) for k in range(3))
        near = is_near(each, turned + Fraction(one[row]), size)
        assert near or (size > Fraction(4e307) and not math.isfinite(each))
