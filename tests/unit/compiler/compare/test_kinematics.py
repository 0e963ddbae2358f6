import math

import pytest

from twinform.compiler.compare.kinematics import Moving
from twinform.compiler.compare.robot import Body, JointView, Leaf, Mass, Robot
from twinform.compiler.compare.values import Numbers, Text
from twinform.ir import Format, Pose
from twinform.ir.transform import Transform

_AT = Transform.from_pose(Pose(xyz=(1, 0, 0)))
_TIP = Transform.from_pose(Pose(xyz=(2, 0, 0)))


def _robot(*joints: JointView) -> Robot:
    names = ["base", *(joint.child for joint in joints)]
    bodies = {name: Body(name, Transform(), Mass()) for name in names}
    return Robot("r", Format.SDF, Transform(), bodies, {joint.name: joint for joint in joints}, {})


def _tip(joint: JointView) -> Transform:
    moving = Moving(_robot(joint), {"base": Transform(), "tip": _TIP})
    (pose,) = moving.poses(["tip"], 3)
    return pose


def test_a_turning_joint_turns_about_its_own_place():
    pose = _tip(JointView("j", "revolute", "base", "tip", _AT, ((0, 0, 1),)))
    angle = pose.rpy()[2]
    assert abs(angle) > 0.1
    assert pose.translation == pytest.approx((1 + math.cos(angle), math.sin(angle), 0))


def test_a_screw_goes_along_as_it_turns():
    pitch = {"screw_thread_pitch": Leaf(Numbers((0.5,)))}
    pose = _tip(JointView("j", "screw", "base", "tip", _AT, ((0, 0, 1),), pitch))
    assert pose.translation[2] == pytest.approx(0.5 * pose.rpy()[2] / (2 * math.pi))


def test_a_sliding_joint_slides_and_a_fixed_one_stays():
    assert _tip(JointView("j", "fixed", "base", "tip", _AT)) == _TIP
    pose = _tip(JointView("j", "prismatic", "base", "tip", _AT, ((0, 1, 0),)))
    assert pose.rotation == Transform().rotation
    assert pose.translation[0] == 2
    assert pose.translation[1] != 0


def test_a_mimic_follows_its_leader():
    mimic = {
        "axis/mimic/@joint": Leaf(Text("leader")),
        "axis/mimic/multiplier": Leaf(Numbers((2.0,))),
        "axis/mimic/offset": Leaf(Numbers((0.25,))),
    }
    leader = JointView("leader", "prismatic", "base", "one", Transform(), ((1, 0, 0),))
    follower = JointView("follower", "prismatic", "base", "two", Transform(), ((1, 0, 0),), mimic)
    moving = Moving(_robot(leader, follower), {name: Transform() for name in ("base", "one", "two")})
    one, two = moving.poses(["one", "two"], 1)
    assert two.translation[0] == pytest.approx(2 * one.translation[0] + 0.25)


def test_positions_are_the_same_in_every_run():
    joint = JointView("elbow", "prismatic", "base", "tip", Transform(), ((1, 0, 0),))
    assert _tip(joint).translation[0] == pytest.approx(_tip(joint).translation[0], abs=0)
