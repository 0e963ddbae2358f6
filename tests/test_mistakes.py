"""Mistakes as people make them: what `check` finds of those in `mistakes/mistakes.toml`, where, and with which hint."""

import shutil
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from twinform.compiler import check
from twinform.compiler.input.finding_spans import SourceFiles, with_columns
from twinform.diagnostics import Diagnostic, Severity

_FOLDER = Path(__file__).parent / "mistakes"
_FILES = {"urdf": "porter_description/urdf/porter.urdf", "sdf": "yard/worlds/yard.sdf"}


@dataclass(frozen=True, slots=True)
class Mistake:
    """One edit in a file without mistakes; `mistakes.toml` explains its fields."""

    file: str
    what: str
    piece: str
    find: str
    write: str
    at: str
    mentions: tuple[str, ...]
    encoding: str
    passes: str

    @classmethod
    def of(cls, row: dict[str, Any]) -> "Mistake":
        """From a table of the file."""
        return cls(
            _FILES[row["in"]],
            row["what"],
            row["piece"],
            row["find"],
            row["write"],
            row.get("at", ""),
            tuple(row["mentions"]),
            row.get("encoding", "utf-8"),
            row.get("passes", ""),
        )

    def make(self, folder: Path) -> tuple[Path, int]:
        """The file with the mistake in a copy of all files, and the line of the mistake."""
        shutil.copytree(_FOLDER, folder, dirs_exist_ok=True)
        (folder / ".git").mkdir()  # without a repository the models beside that of the file are none of its business
        path = folder / self.file
        text = path.read_text("utf-8")
        assert text.count(self.find) == 1
        start = text.index(self.find)
        text = text.replace(self.find, self.write)
        path.write_text(text, self.encoding)
        if self.at:  # the nearest that follows, or else that precedes: `</geometry>` is there many times
            start = text.find(self.at, start) if self.at in text[start:] else text.rindex(self.at, 0, start)
        return path, text.count("\n", 0, start + len(self.at.rstrip("\n"))) + 1

    def is_underlined(self, found: Diagnostic, files: SourceFiles) -> bool:
        """Whether a finding with columns is about the piece that is wrong."""
        where = found.location
        line = files.line(where.file, where.line) or ""
        return line[where.column - 1 : where.end_column - 1] == self.piece if where.column else not self.piece

    def is_what(self, found: Diagnostic, line: int) -> bool:
        """Whether a finding is this mistake: on its line, with all that somebody needs to know to fix it."""
        report = f"{found.message} {found.help or ''}"
        return (
            found.location.line == line
            and found.severity > Severity.INFO
            and all(one in report for one in self.mentions)
        )


_MISTAKES = [Mistake.of(row) for row in tomllib.loads((_FOLDER / "mistakes.toml").read_text("utf-8"))["mistake"]]


@pytest.mark.parametrize("file", _FILES.values())
def test_the_files_have_no_mistake_before_the_edit(file: str) -> None:
    assert check(_FOLDER / file).diagnostics == ()


@pytest.mark.parametrize("mistake", _MISTAKES, ids=lambda each: each.what.replace(" ", "-"))
def test_a_mistake_is_found_on_its_line_with_what_fixes_it(mistake: Mistake, tmp_path: Path) -> None:
    path, line = mistake.make(tmp_path)
    loaded = check(path, passes=mistake.passes)
    files = SourceFiles.of(loaded)
    found = with_columns(loaded.diagnostics, files)
    listed = "\n".join(f"{each.location.line}: {each.severity} {each.message} [{each.help}]" for each in found)
    whole = [each for each in found if mistake.is_what(each, line)]
    assert whole, f"line {line} is not found in\n{listed}"
    assert any(mistake.is_underlined(each, files) for each in whole), [each.location for each in whole]
