"""The case files: what `check` finds in them, and what `convert` makes of them."""

from pathlib import Path

import pytest

from tests.expected import assert_expected
from twinform.testing import Case, CheckOptions, cases

_CASES = Path(__file__).parent / "cases"


_OLDER = "1.4"
"""The version that the cases of versions are written in: the oldest that can be."""
_EXPANDED = CheckOptions(expand_includes=True, paths=(_CASES / "includes/parts",))


def _name(case: Case) -> str:
    return str(case.path.relative_to(_CASES))


@pytest.mark.parametrize("case", [*cases(_CASES / "check"), *cases(_CASES / "xacro")], ids=_name)
def test_check_finds_what_the_case_announces(case: Case) -> None:
    assert case.mismatches() == []


@pytest.mark.parametrize("case", cases(_CASES / "includes", options=_EXPANDED), ids=_name)
def test_expanding_includes_finds_what_the_case_announces(case: Case) -> None:
    assert case.mismatches() == []


@pytest.mark.parametrize("case", cases(_CASES / "convert"), ids=_name)
def test_convert_makes_what_the_case_shows(case: Case) -> None:
    assert case.mismatches() == []
    assert_expected(case.output(), case.output_path)


@pytest.mark.parametrize("case", cases(_CASES / "versions"), ids=_name)
def test_an_older_version_is_written_as_the_case_shows(case: Case) -> None:
    assert case.mismatches() == []
    assert_expected(case.output(_OLDER, to="sdf"), case.path.with_suffix(".expected.sdf"))
