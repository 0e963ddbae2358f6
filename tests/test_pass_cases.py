"""The case files of passes: what a pipeline finds in them, and what it makes of them."""

from pathlib import Path

import pytest

from twinform.testing import PassCase, pass_cases

_CASES = Path(__file__).parent / "cases/passes"


@pytest.mark.parametrize("case", pass_cases(_CASES), ids=lambda case: str(case.path.relative_to(_CASES)))
def test_passes_find_and_make_what_the_case_shows(case: PassCase) -> None:
    assert case.mismatches() == []
    if not case.changes:
        assert not case.output_path.exists()
        return
    if not case.output_path.exists():
        case.output_path.write_text(case.text, encoding="utf-8")
        pytest.fail(f"{case.output_path.name} was missing and is written now; read it before you keep it")
    assert case.text == case.output_path.read_text(encoding="utf-8")
