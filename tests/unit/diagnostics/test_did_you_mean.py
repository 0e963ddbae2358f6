"""The nearest of the known names."""

from collections.abc import Iterator
from itertools import permutations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.diagnostics import did_you_mean, meant_name, nearest_name
from twinform.diagnostics.did_you_mean import edit_distance


@pytest.mark.parametrize(
    ("name", "known", "near"),
    [
        ("foream", ["hand", "forearm"], "forearm"),
        ("Upper-Arm", ["upper_am", "upper_arm"], "upper_arm"),
        ("base link", ["baselink", "base_link"], "base_link"),
        ("joint_1", ["joint_2", "joint_3"], None),
        ("joint_1", ["joint_2", "joint1"], "joint1"),
        ("camera", ["camera1"], "camera1"),
        ("wheel_LF", ["wheel_FL", "wheel_RL", "wheel_FR"], "wheel_FL"),
        ("RF_HAA", ["LF_HAA", "RH_HAA"], None),
        ("left_arm", ["right_arm"], None),
        ("wheelL", ["wheelR"], None),
        ("base_link", ["base_link_l"], None),
        ("arm", ["leg", None, ""], None),
        ("arm", ["arm"], None),
        ("", ["arm"], None),
        (" ", ["arm", "_"], None),
        ("größe", ["grösse"], "grösse"),
        ("a" * 81, ["a" * 80], None),
    ],
)
def test_a_slip_is_distinguished_from_another_name(name: str, known: list[str | None], near: str | None) -> None:
    assert nearest_name(name, known) == near
    assert did_you_mean(name, known) == (f"did you mean {near!r}?" if near else None)


def test_among_very_many_names_nothing_is_looked_for() -> None:
    asked: list[int] = []

    def names(count: int) -> Iterator[str]:
        for number in range(count):
            asked.append(number)
            yield f"name_{number}"

    assert nearest_name("NAME_999", names(1000)) == "name_999"
    assert nearest_name("NAME_999", names(100_000)) is None
    assert len(asked) < 2100


def test_the_order_of_the_names_does_not_matter() -> None:
    names = ["arm_top", "arm_tip", "ARM_TIP", "arm_end"]
    assert {did_you_mean("arm-tap", order) for order in permutations(names)} == {
        "did you mean 'ARM_TIP' or 'arm_tip' or 'arm_top'?"
    }
    assert {nearest_name("Arm_Top", order) for order in permutations(names)} == {"arm_top"}


def test_a_name_with_a_word_more_or_less_is_suggested() -> None:
    assert did_you_mean("elbow_joint", ["elbow", "wrist"]) == "did you mean 'elbow'?"
    assert did_you_mean("base", ["base_link", "base_scan"]) is None
    assert nearest_name("elbow_joint", ["elbow", "wrist"]) is None


def test_of_several_names_none_is_meant() -> None:
    assert nearest_name("izy", ["ixy", "iyz", "izz", "mass"]) is None
    assert did_you_mean("izy", ["ixy", "iyz", "izz", "mass"]) == "did you mean 'ixy' or 'iyz' or 'izz'?"
    assert meant_name("did you mean 'ixy' or 'iyz' or 'izz'?") is None
    assert meant_name("did you mean 'this or that'?") == "this or that"


@given(st.text("ab_", max_size=7), st.text("ab_", max_size=7), st.integers(0, 7))
def test_the_distance_is_that_of_the_definition(one: str, other: str, most: int) -> None:
    assert edit_distance(one, other, most) == min(_distance(one, other), most + 1)


def _distance(one: str, other: str) -> int:
    if not one or not other:
        return len(one) + len(other)
    ways = [_distance(one[1:], other) + 1, _distance(one, other[1:]) + 1]
    ways.append(_distance(one[1:], other[1:]) + (one[0] != other[0]))
    if len(one) > 1 and one[:2] == other[1::-1]:
        ways.append(_distance(one[2:], other[2:]) + 1)
    return min(ways)


_NAMES = st.text("abc", min_size=3, max_size=6)


@given(_NAMES, st.lists(_NAMES, max_size=8))
def test_what_is_meant_is_half_as_far_away_as_all_others(name: str, known: list[str]) -> None:
    near = nearest_name(name, known)
    for other in set(known) - {near, name} if near else ():
        assert _distance(name, other) >= 2 * _distance(name, near or "")
