"""Mistakes as people make them: `tests/mistakes/columns.toml`, each with the piece of text that is wrong."""

import shutil
import tomllib
from dataclasses import dataclass
from pathlib import Path

from testbed.corpus.files import CORPUS, MISSING, ROOT
from twinform.diagnostics import Diagnostic, Severity

FOLDER = ROOT / "tests" / "mistakes"
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

    @property
    def is_plain(self) -> bool:
        """Whether the file is URDF or SDF, and not xacro."""
        return self.file in {"urdf", "sdf"} or self.file.startswith("corpus:")

    def make(self, folder: Path) -> tuple[Path, tuple[str, int, int, int]]:
        """The file to check, in a copy of all files, and the name, line and columns of what is wrong.

        Raises:
            FileNotFoundError: the mistake is one in a file of the corpus, which is not here.
        """
        edited, checked = self.copied(folder)
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

    def copied(self, folder: Path) -> tuple[Path, Path]:
        """The file that the edit is in and the one to check, in a copy of all files, without the mistake.

        Raises:
            FileNotFoundError: they are files of the corpus, which is not here.
        """
        if not self.file.startswith("corpus:"):
            shutil.copytree(FOLDER, folder, dirs_exist_ok=True)
            edited, checked = (folder / name for name in _FILES[self.file])
            return edited, checked
        source = CORPUS / self.file.removeprefix("corpus:")
        if not source.is_file():
            raise FileNotFoundError(MISSING)
        copy = Path(shutil.copy(source, folder / source.name))
        return copy, copy


def is_at(found: Diagnostic, place: tuple[str, int, int, int]) -> bool:
    """Whether a finding is a mistake: a warning or an error whose line and columns are those of the piece."""
    where = found.location
    return (Path(where.file).name, where.line, where.column, where.end_column) == place and (
        found.severity > Severity.INFO and where.end_line == where.line
    )


MISTAKES = [
    Mistake(row.pop("in"), **row) for row in tomllib.loads((FOLDER / "columns.toml").read_text("utf-8"))["mistake"]
]
