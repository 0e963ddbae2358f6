"""Mistakes planted in the examples: which of `planted/planted.toml` `check` finds, on which line, in which words."""

import shutil
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from testbed.corpus.files import ROOT
from twinform.compiler import check
from twinform.diagnostics import Diagnostic

_FOLDER = Path(__file__).parent / "planted"
_EXAMPLES = ROOT / "examples"
_MODEL_FILES = {
    "crate": ("crate/model.sdf",) * 2,
    "courier": ("courier_description/urdf/courier.urdf.xacro",) * 2,
    "wheel.xacro": ("courier_description/urdf/wheel.xacro", "courier_description/urdf/courier.urdf.xacro"),
    "warehouse": ("warehouse.sdf",) * 2,
}
"""The example that is edited and the one that is checked, where that is not KEY.urdf for both."""


@dataclass(frozen=True, slots=True)
class Planted:
    """One edit of an example; the head of `planted.toml` explains the fields."""

    key: str
    what: str
    find: str
    write: str
    after: str = ""
    at: tuple[str, ...] = ()
    says: tuple[str, ...] = ()
    put: dict[str, str] = field(default_factory=dict[str, str])

    def make(self, folder: Path) -> tuple[Path, set[tuple[str, int]]]:
        """The file to check, in a copy of the examples, and the files and lines that a finding may have."""
        shutil.copytree(_EXAMPLES, folder, dirs_exist_ok=True)
        (folder / ".git").mkdir()  # without a repository, what lies beside a file is not searched
        for name, text in self.put.items():
            _put(folder, name, text)
        edited, checked = (folder / name for name in _MODEL_FILES.get(self.key, (f"{self.key}.urdf",) * 2))
        text = edited.read_text("utf-8")
        start = text.index(self.find, text.index(self.after) + len(self.after))
        text = text[:start] + self.write + text[start + len(self.find) :]
        edited.write_text(text, "utf-8")
        files = [edited, *sorted(edited.parent.glob("*.xacro"))]
        places = {(edited.name, text.count("\n", 0, start) + 1)} if not self.at else set[tuple[str, int]]()
        return checked, places | {
            place
            for piece in self.at
            for file in files
            for place in _lines(file, piece, start if file == edited else 0)
        }


def _put(folder: Path, name: str, text: str) -> None:
    """Write a file of a row: `-` deletes it, `@FILE` and `@FILE:N` copy all or N bytes of another one."""
    path = folder / name
    if text == "-":
        path.unlink()
    elif text.startswith("@"):
        source, _, size = text[1:].partition(":")
        path.write_bytes((folder / source).read_bytes()[: int(size) if size else None])
    else:
        path.write_text(text, "utf-8")


def _lines(file: Path, piece: str, start: int) -> set[tuple[str, int]]:
    """The lines of a piece of text that are nearest before and behind a place."""
    text = file.read_text("utf-8")
    starts = {text.find(piece, start), text.rfind(piece, 0, start + 1)} - {-1}
    return {(file.name, text.count("\n", 0, each) + 1) for each in starts}


def _is_what(found: Diagnostic, planted: Planted, places: set[tuple[str, int]]) -> bool:
    """Whether a finding is the planted mistake: on one of its lines, with the words that it takes to fix it."""
    report = f"{found.message} {found.help or ''} {found.fix.title if found.fix else ''}"
    return (Path(found.location.file).name, found.location.line) in places and all(
        one in report for one in planted.says
    )


def _rows() -> list[Planted]:
    tables = tomllib.loads((_FOLDER / "planted.toml").read_text("utf-8"))
    return [Planted(row.pop("in"), **row) for rows in tables.values() for row in rows]


PLANTED = _rows()
MISSED = (_FOLDER / "missed.txt").read_text("utf-8").splitlines()


@pytest.mark.parametrize("planted", PLANTED, ids=lambda each: each.what.replace(" ", "-"))
def test_a_planted_mistake_is_found_on_its_line(planted: Planted, tmp_path: Path) -> None:
    path, places = planted.make(tmp_path)
    found = check(path).diagnostics
    listed = "\n".join(f"{each.location.line}: {each.severity} {each.message} [{each.help}]" for each in found)
    is_found = any(_is_what(each, planted, places) for each in found)
    assert is_found != (planted.what in MISSED), f"{places} {planted.says}\n{listed}"


def test_what_is_missed_is_planted() -> None:
    assert set(MISSED) <= {each.what for each in PLANTED}
    assert len({each.what for each in PLANTED}) == len(PLANTED)
