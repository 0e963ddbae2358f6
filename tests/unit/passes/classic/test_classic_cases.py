import pytest

from tests.unit.passes.pass_cases import all_rules, check_findings, check_idempotence, check_result, pass_cases
from twinform.testing import Case

CASES = pass_cases("classic")
RULES = {
    "added-world-system",
    "ignition-name",
    "incomplete-migration",
    "migrated-plugin",
    "migrated-sensor",
    "parameter-without-counterpart",
    "plugin-without-counterpart",
    "sensor-without-counterpart",
    "shipped-model",
    "unknown-plugin",
    "unread-world-part",
}
BOTH = pytest.mark.parametrize("case", CASES, ids=lambda case: case.path.name)


@BOTH
def test_the_pass_finds_what_the_case_announces(case: Case) -> None:
    check_findings(case)


@BOTH
def test_the_pass_makes_what_the_case_shows(case: Case) -> None:
    check_result(case)


@BOTH
def test_a_second_run_changes_nothing(case: Case) -> None:
    check_idempotence(case)


def test_every_rule_about_classic_has_a_case() -> None:
    assert all_rules("classic") >= RULES
