"""The nearest of the known names."""

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
def test_a_slip_is_told_from_another_name(name: str, known: list[str | None], near: str | None) -> None:
    assert nearest_name(name, known) == near
    assert did_you_mean(name, known) == (f"did you mean {near!r}?" if near else None)


def test_of_very_many_names_only_some_are_compared() -> None:
    assert nearest_name("zzzz_z", (f"name_{number}" for number in range(100_000))) is None
    assert nearest_name("NAME_99999", (f"name_{number}" for number in range(100_000))) == "name_99999"
