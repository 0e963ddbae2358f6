"""What a table cannot say of elements: `notes.toml`."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from reports.mapping.rows import FormatName


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


@cache
def _tables() -> dict[str, Any]:
    return tomllib.loads(Path(__file__).with_name("notes.toml").read_text(encoding="utf-8"))


@cache
def notes() -> tuple[Note, ...]:
    """All notes, in the order of the file."""
    return tuple(map(_note, _tables()["note"]))


def _note(row: dict[str, str | list[str]]) -> Note:
    about, rules, cases = (tuple(row.get(name, ())) for name in ("about", "rules", "cases"))
    return Note(about, " ".join(str(row["text"]).split()), rules, cases)


def told(format: FormatName) -> dict[str, str]:
    """Where rows go that fill no field which both formats have, by path; the tables say it of all others."""
    return _tables()["goes"][format]
