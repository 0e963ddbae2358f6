"""Cases of passes as data: a model file that says itself which passes run over it, and what they find.

`<!-- run: PIPELINE -->` stands somewhere in it, and findings are announced as in all case files. Beside `NAME.urdf` or
`NAME.sdf` lies `NAME.expected` with the same suffix: what the passes make of it, in the same language.
"""

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Literal

import pytest

import twinform
from twinform.diagnostics import Diagnostic, Entry
from twinform.testing import Case, cases

_RUN = re.compile(r"<!--\s*run:\s*(?P<pipeline>.*?)\s*-->")
_CASES = Path(__file__).parents[2] / "cases"


@dataclass(frozen=True)
class Made:
    """What the passes made of a case, and what they said; the errors alone where they refused it."""

    text: str
    diagnostics: tuple[Diagnostic, ...]
    entries: tuple[Entry, ...] = ()

    @property
    def rules(self) -> set[str]:
        return {each.rule.name for each in (*self.diagnostics, *self.entries)}


def pass_cases(folder: str) -> list[Case]:
    return cases(_CASES / folder)


@cache
def run(path: Path) -> Made:
    found = _RUN.search(path.read_text(encoding="utf-8"))
    assert found, f"{path.name} does not say which passes run"
    try:
        made = twinform.convert(path, to=_language(path), passes=found["pipeline"])
    except twinform.CompileError as error:
        return Made("", error.diagnostics)
    return Made(made.text, made.diagnostics, made.ledger.entries)


def check_findings(case: Case) -> None:
    """All that is announced was found, and of what was not announced nothing is worse than a note."""
    found = {(each.location.line, str(each.severity), each.rule.name) for each in run(case.path).diagnostics}
    expected = set(case.expected)
    assert sorted(expected - found) == []
    assert sorted(finding for finding in found - expected if finding[1] != "info") == []


def check_result(case: Case) -> None:
    expected, text = case.path.with_suffix(f".expected{case.path.suffix}"), run(case.path).text
    if not expected.exists():
        expected.write_text(text, encoding="utf-8")
        pytest.fail(f"{expected.name} was missing and is written now; read it before you keep it")
    assert text == expected.read_text(encoding="utf-8")


def check_idempotence(case: Case) -> None:
    """A second run changes nothing."""
    found = _RUN.search(case.path.read_text(encoding="utf-8"))
    assert found
    once = run(case.path).text
    assert not once or twinform.convert(once.encode(), to=_language(case.path), passes=found["pipeline"]).text == once


def _language(path: Path) -> Literal["urdf", "sdf"]:
    return "urdf" if path.suffix == ".urdf" else "sdf"


def all_rules(folder: str) -> set[str]:
    """Every rule that a case of the folder triggers."""
    return {rule for case in pass_cases(folder) for rule in run(case.path).rules}
