"""The cases of `check-plugins`: what it finds in each, as the file announces it.

Rules: unknown-plugin-parameter, plugin-parameter-value, plugin-parameter-count, plugin-reference, wrong-plugin-class,
ignition-plugin-name, wrong-plugin-scope, plugin-not-in-release, unsupported-sensor, missing-world-system,
world-system-needed, default-systems-off.
"""

from collections import Counter
from pathlib import Path

import pytest

import twinform
from twinform.diagnostics import Notes, Severity
from twinform.passes.plugins.check_plugins import CheckPlugins
from twinform.testing.case_files import Case, cases

_CASES = Path(__file__).parents[3] / "cases/plugins"


def found(case: Case) -> Counter[tuple[int, str, str]]:
    document, notes = twinform.load(case.path), Notes()
    assert CheckPlugins().run(document, notes) is document
    return Counter((each.location.line, str(each.severity), each.rule.name) for each in notes.diagnostics)


@pytest.mark.parametrize("case", cases(_CASES), ids=lambda case: case.path.stem)
def test_check_plugins_finds_what_the_case_announces(case: Case) -> None:
    made = found(case)
    assert not case.expected - made
    assert not [each for each in made - case.expected if each[1] != str(Severity.INFO)]


@pytest.mark.parametrize("case", cases(_CASES), ids=lambda case: case.path.stem)
def test_the_cases_are_good_models_otherwise(case: Case) -> None:
    assert twinform.check(case.path).accepted


def test_what_is_wrong_comes_with_what_was_meant() -> None:
    notes = Notes()
    CheckPlugins().run(twinform.load(_CASES / "error_tutorial_parameter.urdf"), notes)
    helps = {each.rule.name: each.help for each in notes.diagnostics}
    assert helps["unknown-plugin-parameter"] == "did you mean odom_publish_frequency?"
    assert helps["plugin-reference"] == "did you mean left_wheel_joint?"


def test_names_of_ignition_are_at_home_in_fortress() -> None:
    notes = Notes()
    CheckPlugins(release="fortress").run(twinform.load(_CASES / "error_names_and_scopes.sdf"), notes)
    assert "ignition-plugin-name" not in {each.rule.name for each in notes.diagnostics}


def test_strict_makes_errors_of_what_gazebo_does_not_load() -> None:
    notes = Notes(strict=True)
    CheckPlugins().run(twinform.load(_CASES / "error_names_and_scopes.sdf"), notes)
    assert notes.has_errors
