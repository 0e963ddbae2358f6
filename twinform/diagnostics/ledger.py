"""The ledger: what a conversion could not express exactly in the target format, and what became of it."""

import math
from collections.abc import Iterable
from enum import StrEnum
from typing import NamedTuple, cast

from twinform.dataclass import dataclass
from twinform.diagnostics.diagnostic import NOWHERE, Location, Rule


class Fate(StrEnum):
    """What happened to an element or attribute that the target cannot express exactly."""

    CARRIED = "carried"
    APPROXIMATED = "approximated"
    DROPPED = "dropped"


class ValueChange(NamedTuple):
    """A value that a pass changed: its path in the JSON of its part, the old and the new value; None for no value."""

    path: str
    was: object
    now: object


@dataclass(frozen=True, slots=True)
class PhysicsChange:
    """The changes that a pass made in a `link` or `joint`, named with the models around it."""

    step: str
    part: str
    name: str
    values: tuple[ValueChange, ...]


@dataclass(frozen=True, slots=True)
class LedgerEntry:
    """One piece of the source and its fate. `weight` counts the elements and attributes that the piece stands for.

    `change` is there where a pass changed the physics for the sake of a consumer.
    """

    fate: Fate
    rule: Rule
    message: str
    location: Location = NOWHERE
    weight: int = 1
    change: PhysicsChange | None = None


@dataclass(frozen=True, slots=True)
class Ledger:
    """Every piece of the source: those expressed are counted, all others are listed."""

    expressed: int = 0
    entries: tuple[LedgerEntry, ...] = ()

    def count(self, fate: Fate) -> int:
        """Count the elements and attributes with a fate; an approximation of nothing was made up, and counts as one."""
        least = int(fate is Fate.APPROXIMATED)
        return sum(max(entry.weight, least) for entry in self.entries if entry.fate is fate)

    def to_json(self) -> str:
        """Return the ledger as `--ledger` writes it."""
        import json  # noqa: PLC0415 - few commands write it

        return json.dumps({"expressed": self.expressed, "entries": list(_rows(self.entries))}, indent=2) + "\n"


def _rows(entries: Iterable[LedgerEntry]) -> Iterable[dict[str, object]]:
    for entry in entries:
        yield {
            "fate": str(entry.fate),
            "path": entry.location.path,
            "line": entry.location.line,
            "rule": entry.rule.name,
            "message": entry.message,
            "weight": entry.weight,
            **({"change": _change(entry.change)} if entry.change else {}),
        }


def _change(change: PhysicsChange) -> dict[str, object]:
    values = [{"path": each.path, "was": _as_json(each.was), "now": _as_json(each.now)} for each in change.values]
    return {"pass": change.step, "part": change.part, "name": change.name, "values": values}


def _as_json(value: object) -> object:
    """Convert a value for JSON; NaN and infinities become text."""
    if isinstance(value, tuple):
        return [_as_json(each) for each in cast("tuple[object, ...]", value)]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value if value is None or isinstance(value, (bool, int, float, str)) else str(value)
