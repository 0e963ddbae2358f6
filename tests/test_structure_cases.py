"""The cases of passes over the structure of models."""

import pytest

from tests.pipelines import ran, structure_cases
from twinform.testing import Case


@pytest.mark.parametrize("case", structure_cases(), ids=lambda case: case.path.name)
def test_a_pass_finds_and_makes_what_the_case_shows(case: Case) -> None:
    made = ran(case)
    assert made.found == case.expected
    expected = case.path.with_suffix(f".expected{case.path.suffix}")
    if made.text and not expected.exists():
        expected.write_text(made.text, encoding="utf-8")
        pytest.fail(f"{expected.name} was missing and is written now; read it before you keep it")
    assert made.text == (expected.read_text(encoding="utf-8") if expected.exists() else "")
