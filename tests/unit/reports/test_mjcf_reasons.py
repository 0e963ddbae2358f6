"""A difference in a file of MJCF is explained by what the conversion said of it, and by nothing else."""

from reports.same_robot.mjcf_package_verdicts import reason_of

_MASSLESS = ("unreadable-mesh", "geom 'cow' is a sdf that only MuJoCo can measure, so that it counts for no mass")
_TEXT = ("stray-text", "text '-' does not belong in <mujoco>")


def test_a_finding_explains_what_comes_of_it() -> None:
    reason = "unreadable-mesh: geom is a sdf that only MuJoCo can measure, so that it counts for no mass"
    causes = ["the mass of link 'body' differs by 1 of 1", "array body_mass"]
    assert reason_of(causes, [_TEXT, _MASSLESS]) == reason


def test_a_finding_of_something_else_explains_nothing() -> None:
    assert reason_of(["the mass of link 'body' differs by 1 of 1"], [_TEXT]) == ""
    assert reason_of(["the pose of link 'body' differs by 1 of 1"], [_TEXT, _MASSLESS]) == ""


def test_all_of_the_differences_of_a_file_have_to_be_explained() -> None:
    assert reason_of(["missing: /mujoco: '-' is not back", "array jnt_range"], [_TEXT]) == ""
