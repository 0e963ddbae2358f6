"""The result of each model of a batch, and the summary and JSON report of all."""

import json
from collections import Counter
from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from enum import StrEnum


class Outcome(StrEnum):
    """How the work on a model ended."""

    CONVERTED = "converted"
    REFUSED = "refused"
    """It has errors."""
    UNREADABLE = "unreadable"
    """It is no model, or cannot be read."""
    UNWRITTEN = "unwritten"
    """The result could not be put in its place."""
    FAILED = "failed"
    """A pass, or the compiler, is at fault."""
    CRASHED = "crashed"
    """The process that worked on it died."""
    LATE = "late"
    """It took longer than it may."""

    @property
    def exit_code(self) -> int:
        """That of `twinform convert` in such a case."""
        return _CODES.get(self, 1)

    @property
    def is_final(self) -> bool:
        """Whether it would end the same way again, as long as nothing changes."""
        return self in {Outcome.CONVERTED, Outcome.REFUSED, Outcome.UNREADABLE}


_CODES = {Outcome.CONVERTED: 0, Outcome.UNREADABLE: 2, Outcome.UNWRITTEN: 2}
Row = dict[str, object]


@dataclass(frozen=True, slots=True, kw_only=True)
class Record:
    """A line of the manifest.

    `digest` is that of the source, `order` that of what was asked for, and `made` that of the result. `alone` says
    whether the source is one file. `message` says in a sentence why there is no result. `diagnostics` are those of
    `check --format json` without notes; `ledger` counts what became of the parts of the model.
    """

    source: str
    digest: str
    request: str
    output: str
    outcome: Outcome
    alone: bool = True
    made: str = ""
    message: str = ""
    diagnostics: list[Row] = field(default_factory=list[Row])
    ledger: dict[str, int] = field(default_factory=dict[str, int])


_LEFT_OUT = ("digest", "request", "made", "alone")
"""What only the manifest needs."""


def summary(records: Iterable[Record], known: int) -> str:
    """How many models met each end; `known` of them in an earlier run."""
    counts = Counter(record.outcome for record in records)
    words = [f"{counts[outcome]} {outcome}" for outcome in Outcome if counts[outcome]]
    total = counts.total()
    before = f" ({known} known from before)" if known else ""
    return f"{total} model{'' if total == 1 else 's'}{': ' if words else ''}{', '.join(words)}{before}"


def report(records: Iterable[Record], to: str) -> str:
    """One JSON object: how many models met each end, and all models in the order of their names."""
    found = sorted(records, key=lambda record: record.source)
    counts = Counter(record.outcome for record in found)
    rows = [{key: value for key, value in asdict(record).items() if key not in _LEFT_OUT} for record in found]
    whole = {"to": to, "summary": {str(each): counts[each] for each in Outcome}, "models": rows}
    return json.dumps(whole, indent=2) + "\n"
