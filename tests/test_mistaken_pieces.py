"""Mistakes as people make them: the line and the columns at which `check` finds those in `mistakes/columns.toml`."""

import shutil
import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.corpus.files import CORPUS
from twinform.compiler import check
from twinform.compiler.input.finding_spans import located
from twinform.diagnostics import Diagnostic, Severity

_FOLDER = Path(__file__).parent / "mistakes"
_TROLLEY = "trolley/trolley.urdf.xacro"
_FILES = {
    "urdf": ("porter_description/urdf/porter.urdf",) * 2,
    "sdf": ("yard/worlds/yard.sdf",) * 2,
    "xacro": (_TROLLEY, _TROLLEY),
    "caster": ("trolley/parts/caster.xacro", _TROLLEY),
}
"""The file with the mistake, and the one that is checked."""


@dataclass(frozen=True, slots=True)
class Mistake:
    """One edit in a file without mistakes; `columns.toml` explains its fields."""

    file: str
    what: str
    find: str
    write: str
    at: str = ""
    passes: str = ""
    missed: str = ""

    def make(self, folder: Path) -> tuple[Path, tuple[str, int, int, int]]:
        """The file to check, in a copy of all files, and the name, line and columns of what is wrong."""
        if self.file.startswith("corpus:"):
            source = CORPUS / self.file.removeprefix("corpus:")
            if not source.is_file():
                pytest.skip("there is no such file of the corpus")
            edited = checked = folder / source.name
            shutil.copy(source, edited)
        else:
            shutil.copytree(_FOLDER, folder, dirs_exist_ok=True)
            edited, checked = (folder / name for name in _FILES[self.file])
        text = edited.read_text("utf-8")
        start = text.index(self.find)
        text = text[:start] + self.write + text[start + len(self.find) :]
        if self.at:
            start = text.rindex(self.at.replace("«", "").replace("»", ""), 0, start)
            text = text[:start] + self.at + text[start + len(self.at) - 2 :]
        begin, end = text.index("«"), text.index("»") - 1
        edited.write_text(text.replace("«", "").replace("»", ""), "utf-8")
        line_start = text.rfind("\n", 0, begin)
        return checked, (edited.name, text.count("\n", 0, begin) + 1, begin - line_start, end - line_start)


def _is_at(found: Diagnostic, place: tuple[str, int, int, int]) -> bool:
    where = found.location
    return (Path(where.file).name, where.line, where.column, where.end_column) == place and (
        found.severity > Severity.INFO and where.end_line == where.line
    )


_MISTAKES = [
    Mistake(row.pop("in"), **row) for row in tomllib.loads((_FOLDER / "columns.toml").read_text("utf-8"))["mistake"]
]


@pytest.mark.parametrize("mistake", _MISTAKES, ids=lambda each: each.what.replace(" ", "-"))
def test_a_mistake_is_found_at_the_piece_that_is_wrong(mistake: Mistake, tmp_path: Path) -> None:
    path, place = mistake.make(tmp_path)
    found = located(check(path, passes=mistake.passes))
    listed = "\n".join(f"{each.location}: {each.severity} {each.message}" for each in found)
    assert any(_is_at(each, place) for each in found) != bool(mistake.missed), f"{place} is not found in\n{listed}"


@pytest.mark.parametrize("name", ["trolley/trolley.urdf.xacro"])
def test_the_files_have_no_mistake_before_the_edit(name: str) -> None:
    assert check(_FOLDER / name).diagnostics == ()
