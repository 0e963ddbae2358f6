"""Robots at sampled joint positions; `test_kinematics.py` in the folder above has how each type of joint moves."""

import pytest

from twinform.compiler.compare.compare_frames import Moving, sampled_positions
from twinform.compiler.compare.compared_robot import ComparedBody, ComparedRobot, JointView, Mass
from twinform.compiler.kinematics import Degree, Leader
from twinform.ir import Format, Pose
from twinform.ir.transform import Transform

_AT = Transform.from_pose(Pose(xyz=(1, 0, 0)))
_SLIDES = Degree((1.0, 0.0, 0.0), slides=True, lower=-1.0, upper=1.0)


def _poses(*joints: JointView) -> dict[str, Transform]:
    names = ["base", *(joint.child for joint in joints)]
    bodies = {name: ComparedBody(name, Transform(), Mass()) for name in names}
    robot = ComparedRobot("r", Format.SDF, Transform(), bodies, {joint.name: joint for joint in joints}, {})
    return Moving(robot, dict.fromkeys(names, _AT)).poses(sampled_positions(joints, 1))


def test_a_link_is_seen_from_the_root_that_it_hangs_from():
    poses = _poses(JointView("j", "fixed", "base", "tip", _AT))
    assert poses["tip"] == Transform()


def test_positions_belong_to_names_and_a_mimic_follows_its_leader():
    leader = JointView("leader", "prismatic", "base", "one", _AT, (_SLIDES,))
    following = Degree(_SLIDES.axis, True, -1.0, 1.0, leader=Leader("leader", 0, 2.0, 0.25, 0.0))
    poses = _poses(leader, JointView("follower", "prismatic", "base", "two", _AT, (following,)))
    alone = _poses(leader)
    assert abs(alone["one"].translation[0]) > 0.01
    assert poses["one"] == alone["one"]
    assert poses["two"].translation[0] == pytest.approx(2 * poses["one"].translation[0] + 0.25)


def test_a_ball_turns_about_axes_of_the_base():
    turned = Transform.from_pose(Pose(rpy=(0.5, 0, 0)))
    degrees = (_SLIDES, _SLIDES, _SLIDES)  # which are not its own
    one, other = (_poses(JointView("j", "ball", "base", "tip", frame, degrees)) for frame in (Transform(), turned))
    assert one["tip"] == other["tip"] != Transform()
