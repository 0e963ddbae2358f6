"""The case files: what `check` finds in them, and what `convert` makes of them."""

from pathlib import Path

import pytest

import twinform
from tests.expected import assert_expected
from twinform.testing import Case, CaseCheckOptions, cases

_CASES = Path(__file__).parent / "cases"


_OLDER = "1.4"
"""The version that the cases of versions are written in: the oldest that can be."""
_EXPANDED = CaseCheckOptions(expand_includes=True, paths=(_CASES / "includes/parts",))


def _name(case: Case) -> str:
    return str(case.path.relative_to(_CASES))


@pytest.mark.parametrize(
    "case", [each for folder in ("check", "mjcf", "xacro") for each in cases(_CASES / folder)], ids=_name
)
def test_check_finds_what_the_case_announces(case: Case) -> None:
    assert case.mismatches() == []


@pytest.mark.parametrize("case", cases(_CASES / "includes", options=_EXPANDED), ids=_name)
def test_expanding_includes_finds_what_the_case_announces(case: Case) -> None:
    assert case.mismatches() == []


@pytest.mark.parametrize("case", cases(_CASES / "convert"), ids=_name)
def test_convert_makes_what_the_case_shows(case: Case) -> None:
    assert case.mismatches() == []
    assert_expected(case.output(), case.output_path)


@pytest.mark.parametrize(
    "case", [each for each in cases(_CASES / "convert") if "refused" not in each.path.stem], ids=_name
)
def test_what_convert_makes_is_the_same_robot(case: Case) -> None:
    assert [each.message for each in twinform.diff(case.path, case.output().encode(), carriers=True).differences] == []


@pytest.mark.parametrize("case", cases(_CASES / "versions"), ids=_name)
def test_an_older_version_is_written_as_the_case_shows(case: Case) -> None:
    assert case.mismatches() == []
    assert_expected(case.output(_OLDER, to="sdf"), case.path.with_suffix(".expected.sdf"))
