import pytest

from twinform.compiler.packaging.controllers import Drive, differential_drive
from twinform.ir import Document
from twinform.passes.plugins.wheels import NotMeasuredError

from .ros2_robots import joint, link, robot, rover

WHEELS = ("left_joint", "right_joint")
SIDES = (("left", 0.3), ("right", -0.3))
STEERED = (
    link("knuckle"),
    link("front"),
    joint("steering", "knuckle", axis="0 0 1"),
    joint("front_joint", "front", "continuous", parent="knuckle"),
)


def drive(document: Document, joints: tuple[str, ...] = WHEELS, others: tuple[str, ...] = ()) -> Drive:
    return differential_drive(document.models[0], joints, others, document.format)


def refused(document: Document, joints: tuple[str, ...] = WHEELS, others: tuple[str, ...] = ()) -> str:
    with pytest.raises(NotMeasuredError) as caught:
        drive(document, joints, others)
    return str(caught.value)


def test_two_wheels_are_a_drive() -> None:
    assert drive(rover()) == Drive(("left_joint",), ("right_joint",), 0.6, 0.2)


def test_four_wheels_are_a_drive() -> None:
    more = [
        part
        for side, y in (("l", 0.3), ("r", -0.3))
        for part in (link(side), joint(f"{side}2", side, "continuous", y=y))
    ]
    found = drive(rover(*more), (*WHEELS, "l2", "r2"))
    assert (found.left, found.right) == (("left_joint", "l2"), ("right_joint", "r2"))


def test_a_caster_that_nobody_steers_is_in_order() -> None:
    assert drive(rover(*STEERED)).separation == 0.6


def test_wheels_may_be_sprung() -> None:
    sprung = robot(
        *(link(each) for each in ("left", "right", "left_arm", "right_arm")),
        *(joint(f"{side}_spring", f"{side}_arm", "prismatic", y=y, axis="0 0 1") for side, y in SIDES),
        *(joint(f"{side}_joint", side, "continuous", parent=f"{side}_arm") for side, _ in SIDES),
    )
    assert drive(sprung).separation == 0.6
    reason = "joint 'left_spring' moves the wheel of joint 'left_joint'"
    assert refused(sprung, others=("left_spring", "right_spring")) == reason


def test_a_car_is_no_differential_drive() -> None:
    assert refused(rover(*STEERED), others=("steering",)) == "the wheel of joint 'front_joint' is steered"


def test_an_arm_whose_joint_turns_without_end_steers_nothing() -> None:
    arm = (link("a"), link("b"), joint("pan", "a", axis="0 0 1"))
    raised = '<joint name="roll" type="continuous"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/></joint>'
    assert drive(rover(*arm, raised), others=("pan",)).separation == 0.6


@pytest.mark.parametrize(
    ("document", "joints", "reason"),
    [
        (rover(axis="0 -1 0"), WHEELS, "the axle of joint 'left_joint' does not point to the left, along y"),
        (rover(radius=0.1), WHEELS, "the wheels have radii from 0.1 to 0.2 m"),
        (rover(), ("left_joint",), "there are 0 wheels on the left and 1 on the right"),
        (rover(), (*WHEELS, "nobody"), "there is no joint 'nobody'"),
        (rover(*STEERED), (*WHEELS, "front_joint"), "joint 'steering' moves the wheel of joint 'front_joint'"),
    ],
)
def test_other_wheels_are_refused_with_the_reason(document: Document, joints: tuple[str, ...], reason: str) -> None:
    assert refused(document, joints) == reason


def test_wheels_at_one_place_are_refused() -> None:
    document = robot(link("a"), link("b"), joint("j", "a", "continuous"), joint("k", "b", "continuous"))
    assert refused(document, ("j", "k")) == "there are 0 wheels on the left and 2 on the right"
