"""The case files of MJCF: what is reported where a model is converted, and what it becomes."""

from pathlib import Path

import pytest

from tests.expected import assert_expected
from twinform.testing import MjcfCase, mjcf_cases

_CASES = Path(__file__).parent / "cases/to_mjcf"


def _name(case: MjcfCase) -> str:
    return str(case.path.relative_to(_CASES))


_ALL = pytest.mark.parametrize("case", mjcf_cases(_CASES), ids=_name)


@_ALL
def test_the_conversion_reports_what_the_case_announces(case: MjcfCase) -> None:
    assert case.mismatches() == []


@_ALL
def test_the_case_becomes_the_mjcf_beside_it(case: MjcfCase) -> None:
    assert_expected(case.text, case.output_path)
