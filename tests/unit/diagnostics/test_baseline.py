from pathlib import PurePosixPath

import pytest
from hypothesis import given
from hypothesis import strategies as st

from twinform.diagnostics import Diagnostic, Location, Severity
from twinform.diagnostics.baseline import Baseline, BaselineError, BaselineRun, KnownFinding
from twinform.diagnostics.rules import DANGLING_LINK, NOT_WELL_FORMED

_TEXTS = st.text(st.characters(codec="utf-8"), max_size=8)
_FINDINGS = st.builds(KnownFinding, _TEXTS, _TEXTS, _TEXTS, _TEXTS)


def _finding(message: str = "gone", line: int = 3, path: str = "/robot/joint[2]", file: str = "a.urdf") -> Diagnostic:
    return Diagnostic(DANGLING_LINK, message, Location(file, line, path), Severity.ERROR)


def _run(*findings: Diagnostic, known: Baseline | None = None) -> BaselineRun:
    run = BaselineRun(known or Baseline(), lambda name: PurePosixPath(name).as_posix())
    run.unknown("a.urdf", findings)
    run.add(["a.urdf"], {})
    return run


@given(st.dictionaries(_FINDINGS, st.integers(min_value=1, max_value=5)))
def test_a_baseline_that_is_written_is_read_as_it_was(counts: dict[KnownFinding, int]) -> None:
    text = Baseline(counts).to_json()
    assert Baseline.parse(text).counts == counts
    assert Baseline.parse(text).to_json() == text


def test_each_finding_has_a_line_and_they_are_sorted() -> None:
    text = Baseline.of(
        [KnownFinding("b", "r", "", "m"), KnownFinding("a", "r", "", "ä"), KnownFinding("b", "r", "", "m")]
    )
    assert text.to_json().splitlines() == [
        "{",
        '  "twinform-baseline": 1,',
        '  "findings": [',
        '    {"file": "a", "rule": "r", "path": "", "message": "ä"},',
        '    {"file": "b", "rule": "r", "path": "", "message": "m", "count": 2}',
        "  ]",
        "}",
    ]


@pytest.mark.parametrize(
    "moved",
    [
        _finding(line=90),
        _finding(path="/robot/joint[7]"),
        _finding()
    ],
)  # fmt: skip
def test_a_finding_that_moved_is_the_same(moved: Diagnostic) -> None:
    known = _run(_finding()).updated(lambda _: True)
    assert BaselineRun(known, str).unknown("a.urdf", [moved]) == ()


def test_numbers_of_lines_in_messages_do_not_matter_and_other_words_do() -> None:
    known = _run(_finding("as in line 4, column 2")).updated(lambda _: True)
    assert BaselineRun(known, str).unknown("a.urdf", [_finding("as in line 9, column 1")]) == ()
    assert BaselineRun(known, str).unknown("a.urdf", [_finding("as in row 4")])
    assert BaselineRun(known, str).unknown("b.urdf", [_finding("as in line 4, column 2", file="b.urdf")])


def test_one_more_of_a_kind_is_a_new_one() -> None:
    known = _run(_finding(), _finding()).updated(lambda _: True)
    again = [_finding(line=line) for line in (1, 2, 3)]
    assert BaselineRun(known, str).unknown("a.urdf", again) == (again[2],)


def test_what_does_not_occur_any_more_is_counted_for_the_files_that_were_seen() -> None:
    known = Baseline({KnownFinding("a.urdf", "r", "", "m"): 2, KnownFinding("b.urdf", "r", "", "m"): 1})
    run = _run(known=known)
    assert run.gone == 2
    assert set(run.updated(lambda _: True).counts) == {KnownFinding("b.urdf", "r", "", "m")}
    assert not run.updated(lambda name: name != "b.urdf").counts


def test_fatal_errors_are_in_a_baseline_and_notes_are_not() -> None:
    fatal = Diagnostic(NOT_WELL_FORMED, "cut off", Location("a.urdf", 1), Severity.ERROR)
    note = Diagnostic(DANGLING_LINK, "by the way", Location("a.urdf", 1), Severity.INFO)
    run = _run(fatal, note)
    assert [known.rule for known in run.found] == ["not-well-formed"]
    assert BaselineRun(run.updated(lambda _: True), str).unknown("a.urdf", [fatal, note]) == (note,)


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("", 1, "no JSON"),
        ('{\n"twinform-baseline": 1,\n<<<<<<< ours\n', 3, "no JSON"),
        ("[]", 1, "no key 'twinform-baseline'"),
        ('{"version": "2.1.0"}', 1, "this is no baseline"),
        ('{\n  "twinform-baseline": 2\n}', 2, "of version 2, and this twinform knows version 1"),
        ('{\n  "twinform-baseline": 1,\n  "findings": {}\n}', 3, "has to be a list"),
        ('{\n"twinform-baseline": 1,\n"findings": [\n{"file": "a", "rule": "b"}\n]}', 4, "file, rule, path, message"),
        (
            '{"twinform-baseline": 1, "findings": [\n{"file": "", "rule": "", "path": "", "message": "", "count": 0}]}',
            2,
            "positive whole number",
        ),
        ('{"twinform-baseline": 1, "findings": [3]}', 0, "a finding is an object"),
        ("[" * 100_000, 0, "no JSON"),
    ],
)
def test_what_is_no_baseline_is_said_with_its_line(text: str, line: int, words: str) -> None:
    with pytest.raises(BaselineError, match=words) as caught:
        Baseline.parse(text)
    assert caught.value.line == line
