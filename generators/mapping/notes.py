"""What a table cannot express about elements: `notes.toml`."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from twinform.server.mapping import FormatName

_TABLES: dict[str, Any] = tomllib.loads(Path(__file__).with_name("notes.toml").read_text(encoding="utf-8"))


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
        """What it is about, as the page writes it: `URDF joint/limit`."""
        return [f"{each.partition(':')[0].upper()} {each.partition(':')[2]}" for each in self.about]


@cache
def notes() -> tuple[Note, ...]:
    """All notes, in the order of the file."""
    return tuple(map(_note, _TABLES["note"]))


def _note(row: dict[str, str | list[str]]) -> Note:
    about, rules, cases = (tuple(row.get(name, ())) for name in ("about", "rules", "cases"))
    return Note(about, " ".join(str(row["text"]).split()), rules, cases)


def destinations(format: FormatName) -> dict[str, str]:
    """Where rows go that fill no field which both formats have, by path; the tables have it for all others."""
    return _TABLES["goes"][format]
