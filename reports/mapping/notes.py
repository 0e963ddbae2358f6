"""What a table cannot say of elements: `notes.toml`."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from reports.mapping.rows import FormatName, Row

_FILE = Path(__file__).with_name("notes.toml")


@dataclass(frozen=True, slots=True)
class Note:
    """A few sentences about elements of one or both formats, each `format:path`."""

    about: tuple[str, ...]
    text: str
    rules: tuple[str, ...] = ()
    cases: tuple[str, ...] = ()

    @property
    def sections(self) -> set[tuple[str, str]]:
        """The formats and definitions in whose sections it stands."""
        return {(each.partition(":")[0], each.partition(":")[2].partition("/")[0]) for each in self.about}

    @property
    def paths(self) -> list[str]:
        """What it is about, as a reader says it: `URDF joint/limit`."""
        return [f"{each.partition(':')[0].upper()} {each.partition(':')[2]}" for each in self.about]


@dataclass(frozen=True, slots=True)
class Notes:
    """The file."""

    notes: tuple[Note, ...]
    goes: dict[str, dict[str, str]]


@cache
def _read() -> Notes:
    said = tomllib.loads(_FILE.read_text(encoding="utf-8"))
    return Notes(tuple(map(_note, said["note"])), said["goes"])


def _note(row: dict[str, str | list[str]]) -> Note:
    about, rules, cases = (tuple(row.get(name, ())) for name in ("about", "rules", "cases"))
    return Note(about, " ".join(str(row["text"]).split()), rules, cases)


def notes() -> tuple[Note, ...]:
    """All notes, in the order of the file."""
    return _read().notes


def goes(row: Row) -> str | None:
    """Where a row goes that fills no field which both formats have; None where the tables say it."""
    return _read().goes[row.format].get(row.path)


def told(format: FormatName) -> dict[str, str]:
    """The same for all rows that the file knows."""
    return _read().goes[format]
