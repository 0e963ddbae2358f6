"""All findings about the case files: places, messages, what was found and expected, and the ledger.

The cases announce which rules speak on which line; here stands the rest, in `tests/findings/`, one file for each case
with findings.
"""

import os
import re
from collections.abc import Iterable, Iterator
from contextlib import chdir
from pathlib import Path
from typing import Literal

import pytest

import twinform
from twinform.diagnostics import Diagnostic, LedgerEntry, Location
from twinform.testing import Case, cases

_TESTS = Path(__file__).parent
_CASES, _FINDINGS = _TESTS / "cases", _TESTS / "findings"
_PASSES = re.compile(r"<!--\s*passes:\s*(.*?)\s*-->", re.DOTALL)
_FOLDERS = ("check", "convert", "elements", "from_mjcf", "mjcf", "passes", "versions", "whole")
"""The cases of passes stay in their format, and all others are converted to the other one, those of MJCF to SDF."""
_LOOKED_IN = re.compile(r"(?<=looked in )[^;]+")
"""Folders of this machine, which stand in the help about files that are not found."""
_OTHER: dict[str, Literal["urdf", "sdf"]] = {"urdf": "sdf", "sdf": "urdf", "mjcf": "sdf"}


def _all() -> list[Case]:
    return [case for folder in _FOLDERS for case in cases(_CASES / folder) if case.path.suffix[1:] in _OTHER]


def _name(case: Case) -> str:
    return case.path.relative_to(_CASES).as_posix()


@pytest.mark.parametrize("case", _all(), ids=_name)
def test_findings_are_what_was_read_over_once(case: Case) -> None:
    findings = _findings_of(case)
    expected = _FINDINGS / f"{_name(case)}.txt"
    if findings and not expected.exists():
        expected.parent.mkdir(parents=True, exist_ok=True)
        expected.write_text(findings, encoding="utf-8")
        pytest.fail(f"{expected.name} was missing and is written now; read it before you keep it")
    assert findings == (expected.read_text(encoding="utf-8") if expected.exists() else "")


def test_nothing_is_kept_about_cases_that_are_gone() -> None:
    kept = {path.relative_to(_FINDINGS).as_posix() for path in _FINDINGS.rglob("*.txt")}
    assert kept <= {f"{_name(case)}.txt" for case in _all()}


def _findings_of(case: Case) -> str:
    with chdir(case.path.parent):
        try:
            made = _converted(case)
        except twinform.CompileError as error:
            return _text(error.diagnostics, ())
    return _text(made.diagnostics, made.ledger.entries)


def _converted(case: Case) -> twinform.Conversion:
    own = case.path.suffix[1:]
    if not _name(case).startswith("passes/"):
        return twinform.convert(Path(case.path.name), to=_OTHER[own])
    pipeline = _PASSES.search(case.path.read_text(encoding="utf-8"))
    assert pipeline is not None, "the case names no pipeline"
    return twinform.convert(Path(case.path.name), to=_OTHER[_OTHER[own]], passes=pipeline[1])


def _text(diagnostics: Iterable[Diagnostic], entries: Iterable[LedgerEntry]) -> str:
    lines = [line for each in diagnostics for line in _of_finding(each)]
    lines += [line for each in entries for line in _of_entry(each)]
    return "".join(f"{line}\n" for line in lines)


def _of_finding(one: Diagnostic) -> Iterator[str]:
    yield f"{one.severity} {one.rule.name} {_place(one.location)}"
    yield f"    {one.message}"
    for word, value in (("found", one.found), ("expected", one.expected), ("help", one.help)):
        if value is not None:
            yield f"    {word}: {_LOOKED_IN.sub('...', value)}"
    yield from (f"    related: {_place(where)}" for where in one.related)


def _of_entry(one: LedgerEntry) -> Iterator[str]:
    yield f"{one.fate} {one.rule.name} {_place(one.location)} ({one.weight})"
    yield f"    {one.message}"


def _place(where: Location) -> str:
    return f"{os.path.relpath(where.file) if where.file else '-'}:{where.line} {where.path or '-'}"
