"""The nearest of the known names."""

from collections.abc import Iterator
from itertools import permutations

import pytest

from twinform.diagnostics import did_you_mean, nearest_name


@pytest.mark.parametrize(
    ("name", "known", "near"),
    [
        ("foream", ["hand", "forearm"], "forearm"),
        ("Upper-Arm", ["upper_am", "upper_arm"], "upper_arm"),
        ("base link", ["baselink", "base_link"], "base_link"),
        ("joint_1", ["joint_2", "joint_3"], None),
        ("joint_1", ["joint_2", "joint1"], "joint1"),
        ("camera", ["camera1"], "camera1"),
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
    names = ["arm_a", "arm_b", "ARM_B", "arm_c"]
    assert {nearest_name("arm-x", order) for order in permutations(names)} == {"arm_c"}
    assert {nearest_name("Arm_B", order) for order in permutations(names)} == {"ARM_B"}
