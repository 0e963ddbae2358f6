import pytest

import twinform
from tests.unit.passes.pass_cases import all_rules, check_findings, check_idempotence, check_result, pass_cases
from twinform.testing import Case

CASES = pass_cases("control")
RULES = {
    "converted-ros2-control",
    "converted-transmission",
    "foreign-hardware-interface",
    "foreign-transmission",
    "unconverted-transmission",
    "unsayable-in-transmissions",
}
BOTH = pytest.mark.parametrize("case", CASES, ids=lambda case: case.path.name)


@BOTH
def test_the_passes_find_what_the_case_announces(case: Case) -> None:
    check_findings(case)


@BOTH
def test_the_passes_make_what_the_case_shows(case: Case) -> None:
    check_result(case)


@BOTH
def test_a_second_run_changes_nothing(case: Case) -> None:
    check_idempotence(case)


def test_every_rule_about_control_has_a_case() -> None:
    assert all_rules("control") >= RULES


THERE, BACK = "ros2-control-from-transmissions", "transmissions-from-ros2-control"


@pytest.mark.parametrize(
    "case", [case for case in CASES if "simple" in case.path.name], ids=lambda case: case.path.name
)
def test_there_back_and_there_is_there(case: Case) -> None:
    language = "urdf" if case.path.suffix == ".urdf" else "sdf"
    once = twinform.convert(case.path, to=language, passes=THERE).text
    thrice = twinform.convert(once.encode(), to=language, passes=f"{BACK},{THERE}").text
    assert thrice == once
