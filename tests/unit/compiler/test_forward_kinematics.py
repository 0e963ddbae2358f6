"""Forward kinematics by the names of joints; `test_kinematics.py` holds the numbers to Pinocchio."""

import math

import pytest

import twinform

ARM = """<robot name="arm">
<link name="base"/><link name="upper"/><link name="lower"/>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
<joint name="elbow" type="continuous"><origin xyz="1 0 0"/><parent link="upper"/><child link="lower"/>
<axis xyz="0 0 1"/></joint>
</robot>"""


def test_links_are_where_the_joints_put_them() -> None:
    poses = twinform.forward_kinematics(twinform.loads(ARM), {"shoulder": math.pi / 2, "elbow": [math.pi / 2]})
    assert poses["base"].is_identity
    expected = ((-1, 0, 0, 0), (0, -1, 0, 1), (0, 0, 1, 0), (0, 0, 0, 1))
    for row, wanted in zip(poses["lower"].matrix, expected, strict=True):
        assert row == pytest.approx(wanted)


def test_joints_that_are_not_named_are_at_zero() -> None:
    assert twinform.forward_kinematics(twinform.loads(ARM))["lower"].translation == (1.0, 0.0, 0.0)


def test_what_there_is_not_is_an_error() -> None:
    document = twinform.loads(ARM)
    with pytest.raises(KeyError, match=r"there is no joint 'sholder'; did you mean 'shoulder'\?"):
        twinform.forward_kinematics(document, {"sholder": 1.0})
    with pytest.raises(ValueError, match="continuous joint 'elbow' takes at most 1 positions, not 2"):
        twinform.forward_kinematics(document, {"elbow": (1.0, 2.0)})
