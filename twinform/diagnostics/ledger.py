"""The ledger: what a conversion could not express exactly in the target format, and what became of it."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

from twinform.diagnostics.location import NOWHERE, Location
from twinform.diagnostics.rule import Rule


class Fate(StrEnum):
    """What became of an element or attribute that the target has no exact form of."""

    CARRIED = "carried"
    APPROXIMATED = "approximated"
    DROPPED = "dropped"


@dataclass(frozen=True, slots=True)
class Entry:
    """One piece of the source and its fate. `weight` counts the elements and attributes that the piece stands for."""

    fate: Fate
    rule: Rule
    message: str
    location: Location = NOWHERE
    weight: int = 1


@dataclass(frozen=True, slots=True)
class Ledger:
    """Every piece of the source: those expressed are counted, all others are listed."""

    expressed: int = 0
    entries: tuple[Entry, ...] = ()

    def count(self, fate: Fate) -> int:
        """How many elements and attributes met this fate."""
        return sum(entry.weight for entry in self.entries if entry.fate is fate)

    def to_json(self) -> str:
        """The ledger as `--ledger` writes it."""
        import json  # noqa: PLC0415 - few commands write it

        return json.dumps({"expressed": self.expressed, "entries": list(_rows(self.entries))}, indent=2) + "\n"


def _rows(entries: Iterable[Entry]) -> Iterable[dict[str, object]]:
    for entry in entries:
        yield {
            "fate": str(entry.fate),
            "path": entry.location.path,
            "line": entry.location.line,
            "rule": entry.rule.name,
            "message": entry.message,
            "weight": entry.weight,
        }
