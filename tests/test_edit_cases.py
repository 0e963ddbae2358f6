"""Edits that once did not win: every file of `tests/cases/edits` is converted, edited as its comments say, and judged.

A comment `edit:` has an edit of the converted file, `refused:` one that has to be an error, and `pass:` a pipeline that
runs on it; `mjcf:` and `sdf:` are edits of the file of MJCF or SDF that it becomes. Each is tried on its own.
"""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import twinform
from testbed.corpus.files import ROOT
from testbed.edits import Edit
from testbed.edits.edited_file import Language
from testbed.edits.judging import Outcome, judge, judge_edits, unedited
from testbed.edits.plainly import Plainly

pytestmark = pytest.mark.slow

CASES = Path(__file__).parent / "cases" / "edits"
_LANGUAGES: dict[str, Language] = {".urdf": "urdf", ".sdf": "sdf", ".mjcf": "mjcf"}
_OF_KINDS: dict[str, Language] = {"mjcf": "mjcf", "sdf": "sdf"}
_WISH = re.compile(r"<!-- (edit|refused|pass|mjcf|sdf): (.*?) -->")


def _cases() -> Iterator[object]:
    for path in sorted(CASES.iterdir()):
        for number, (kind, text) in enumerate(_WISH.findall(path.read_text(encoding="utf-8")), start=1):
            yield pytest.param(path, kind, text, id=f"{path.name}:{number}")


@pytest.mark.parametrize(("path", "kind", "text"), list(_cases()))
def test_an_edit_wins(path: Path, kind: str, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    source = _LANGUAGES[path.suffix]
    usual: Language = "sdf" if source == "urdf" else "urdf"
    to = _OF_KINDS.get(kind, usual)
    made = twinform.convert(path, to=to).text.encode()
    before = unedited(made, source)
    if kind == "pass":
        passed = twinform.convert(made, to=to, passes=text).text.encode()
        verdict = judge(before, passed, plainly=Plainly.NONE if text.startswith("attach") else Plainly.SKELETON)
    else:
        edit = Edit.from_text(text)
        verdict = judge_edits(before, [edit], edit.apply(made))
    assert verdict.differences == ()
    assert (verdict.outcome is Outcome.REFUSED) == (kind == "refused"), verdict.rules
