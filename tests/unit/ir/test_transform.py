"""Rigid transforms; numpy is the judge."""

import math
from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.ir import Pose, Vector3
from twinform.ir.transform import Transform

ANGLES = st.floats(-math.pi, math.pi)
NUMBERS = st.floats(-10, 10)


def rotation(rpy: Vector3) -> np.ndarray:
    roll, pitch, yaw = rpy
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (np.cos, np.sin))
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def matrix(transform: Transform) -> np.ndarray:
    made = np.eye(4)
    made[:3, :3] = np.reshape(transform.rotation, (3, 3))
    made[:3, 3] = transform.translation
    return made


poses = st.builds(Pose, xyz=st.tuples(NUMBERS, NUMBERS, NUMBERS), rpy=st.tuples(ANGLES, ANGLES, ANGLES))


@given(poses)
def test_rpy_is_about_fixed_axes(pose: Pose) -> None:
    assert pose.rpy is not None
    np.testing.assert_allclose(matrix(Transform.from_pose(pose))[:3, :3], rotation(pose.rpy), atol=1e-15)


@given(poses, poses)
def test_composing_is_the_product_of_the_matrices(outer: Pose, inner: Pose) -> None:
    a, b = Transform.from_pose(outer), Transform.from_pose(inner)
    np.testing.assert_allclose(matrix(a.compose(b)), matrix(a) @ matrix(b), atol=1e-14)


@given(poses)
def test_a_transform_after_its_inverse_is_the_identity(pose: Pose) -> None:
    transform = Transform.from_pose(pose)
    np.testing.assert_allclose(matrix(transform.compose(transform.inverse())), np.eye(4), atol=1e-14)


@given(poses, st.tuples(NUMBERS, NUMBERS, NUMBERS))
def test_points_are_turned_and_moved_and_directions_only_turned(pose: Pose, point: Vector3) -> None:
    transform = Transform.from_pose(pose)
    np.testing.assert_allclose(transform.apply(point), (matrix(transform) @ [*point, 1])[:3], atol=1e-13)
    np.testing.assert_allclose(transform.rotate(point), matrix(transform)[:3, :3] @ point, atol=1e-13)


@given(poses)
def test_rpy_and_quaternion_give_the_rotation_back(pose: Pose) -> None:
    transform = Transform.from_pose(pose)
    again = Transform.from_pose(Pose(rpy=transform.rpy()))
    np.testing.assert_allclose(again.rotation, transform.rotation, atol=1e-14)
    again = Transform.from_pose(Pose(quat_xyzw=transform.quaternion()))
    np.testing.assert_allclose(again.rotation, transform.rotation, atol=1e-14)


@pytest.mark.parametrize("away", [0.0, 1e-16, 1e-12, 1e-9, 1e-8, 1e-6, 1e-4, 4e-3])
@pytest.mark.parametrize("sign", [-1, 1])
def test_rpy_loses_nothing_near_gimbal_lock(away: float, sign: int) -> None:
    for roll, yaw in product(np.linspace(-3, 3, 13), repeat=2):
        turned = Transform.from_pose(Pose(rpy=(float(roll), sign * (math.pi / 2 - away), float(yaw))))
        again = Transform.from_pose(Pose(rpy=turned.rpy()))
        np.testing.assert_allclose(again.rotation, turned.rotation, atol=3e-15)


@given(st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: math.hypot(*q) > 1e-3), st.floats(0.1, 10))
def test_a_quaternion_is_normalized(quaternion: tuple[float, float, float, float], scale: float) -> None:
    x, y, z, w = quaternion
    one = Transform.from_pose(Pose(quat_xyzw=quaternion))
    other = Transform.from_pose(Pose(quat_xyzw=(x * scale, y * scale, z * scale, w * scale)))
    np.testing.assert_allclose(one.rotation, other.rotation, atol=1e-14)
    turned = matrix(one)[:3, :3]
    np.testing.assert_allclose(turned @ turned.T, np.eye(3), atol=1e-14)


def test_degrees_are_turned_into_radians() -> None:
    degrees = Transform.from_pose(Pose(rpy=(10, 20, 30), degrees=True))
    radians = Transform.from_pose(Pose(rpy=(math.radians(10), math.radians(20), math.radians(30))))
    assert degrees == radians


@pytest.mark.parametrize(
    "pose", [None, Pose(), Pose(xyz=(0, 0, 0)), Pose(rpy=(0, 0, -0.0)), Pose(quat_xyzw=(0, 0, 0, 1))]
)
def test_what_is_not_written_is_zero(pose: Pose | None) -> None:
    assert Transform.from_pose(pose).is_identity
    assert Transform.from_pose(pose).inverse().is_identity


def test_the_identity_leaves_a_pose_in_its_notation() -> None:
    pose = Pose(xyz=(0.1, 0.2, 0.3), rpy=(10, 20, 30), degrees=True)
    transform = Transform.from_pose(pose)
    assert Transform().compose(transform).compose(Transform()).to_pose() == pose
    assert transform.to_pose("there") == pose.copy(relative_to="there")


def test_a_computed_pose_leaves_out_zeros_and_has_no_negative_ones() -> None:
    there = Transform.from_pose(Pose(xyz=(0.0, 1.0, 0.0)))
    back = there.inverse().to_pose()
    assert back == Pose(xyz=(0.0, -1.0, 0.0))
    assert str(back.xyz) == "(0.0, -1.0, 0.0)"
    assert there.compose(there.inverse()).to_pose() == Pose()
