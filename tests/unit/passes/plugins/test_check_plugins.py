from pathlib import Path

import twinform
from twinform.diagnostics import Notes
from twinform.passes.plugins.check_plugins import CheckPlugins

CASES = Path(__file__).parents[3] / "cases/passes/plugins"


def noted(case: str, check: CheckPlugins, *, strict: bool = False) -> Notes:
    document, notes = twinform.load(CASES / case), Notes(strict=strict)
    assert check.run(document, notes) is document
    return notes


def test_what_is_wrong_comes_with_what_was_meant() -> None:
    notes = noted("error_tutorial_parameter.urdf", CheckPlugins())
    helps = {each.rule.name: each.help for each in notes.diagnostics}
    assert helps["unknown-plugin-parameter"] == "did you mean odom_publish_frequency?"
    assert helps["plugin-reference"] == "did you mean left_wheel_joint?"


def test_names_of_ignition_are_at_home_in_fortress() -> None:
    notes = noted("error_names_and_scopes.sdf", CheckPlugins(release="fortress"))
    assert "ignition-plugin-name" not in {each.rule.name for each in notes.diagnostics}


def test_strict_makes_errors_of_what_gazebo_does_not_load() -> None:
    assert noted("error_names_and_scopes.sdf", CheckPlugins(), strict=True).has_errors
