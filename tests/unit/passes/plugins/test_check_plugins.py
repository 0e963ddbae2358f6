from pathlib import Path

import twinform
from twinform.diagnostics import DiagnosticSink
from twinform.passes.plugins.check_plugins import CheckPlugins

CASES = Path(__file__).parents[3] / "cases/passes/plugins"


def noted(case: str, check: CheckPlugins, *, strict: bool = False) -> DiagnosticSink:
    document, sink = twinform.load(CASES / case), DiagnosticSink(strict=strict)
    assert check.run(document, sink) is document
    return sink


def test_what_is_wrong_comes_with_what_was_meant() -> None:
    sink = noted("error_tutorial_parameter.urdf", CheckPlugins())
    helps = {each.rule.name: each.help for each in sink.diagnostics}
    assert helps["unknown-plugin-parameter"] == "did you mean odom_publish_frequency?"
    assert helps["plugin-reference"] == "did you mean left_wheel_joint?"


def test_names_of_ignition_are_right_in_fortress() -> None:
    sink = noted("error_names_and_scopes.sdf", CheckPlugins(release="fortress"))
    assert "ignition-plugin-name" not in {each.rule.name for each in sink.diagnostics}


def test_strict_makes_errors_of_what_gazebo_does_not_load() -> None:
    assert noted("error_names_and_scopes.sdf", CheckPlugins(), strict=True).has_errors
