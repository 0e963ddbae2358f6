"""What came of each model of a batch."""

import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

from twinform.compiler.batch.dependencies import Dependency

Row = dict[str, object]


class Outcome(StrEnum):
    """How the work on a model ended."""

    CONVERTED = "converted"
    ACCEPTED = "accepted"
    """`check` finds no error."""
    MEASURED = "measured"
    SAME = "same"
    """The two models are the same robot."""
    DIFFERENT = "different"
    MISSING = "missing"
    """There is no model of this name to compare with."""
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
        """The exit code of the command for one model with this outcome."""
        return _CODES.get(self, 1)

    @property
    def is_good(self) -> bool:
        """Whether there is nothing to report."""
        return self.exit_code == 0

    @property
    def is_final(self) -> bool:
        """Whether it would end the same way again, as long as nothing changes."""
        return self in _FINAL


_GOOD = (Outcome.CONVERTED, Outcome.ACCEPTED, Outcome.MEASURED, Outcome.SAME)
_FINAL = frozenset({*_GOOD, Outcome.DIFFERENT, Outcome.REFUSED, Outcome.UNREADABLE})
_CODES = {**dict.fromkeys(_GOOD, 0), Outcome.UNREADABLE: 2, Outcome.UNWRITTEN: 2}


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelRecord:
    """What came of a model, as the manifest keeps it.

    `request` is the digest of what was asked for. `results` are the files that were written, `dependencies` and
    `variables` what the work depended on, noted at a `time` in nanoseconds; without dependencies it is done again.
    `kept` is the record of the results of an earlier run, which stay where they are until there is a verdict on the
    model: it counts again as soon as everything is as it was then.
    `message` is the reason why there is no result. `diagnostics` are those of `check --format json`; `ledger` counts
    what became of the parts of the model. `details` are what else there is to report: statistics, differences.
    """

    source: str
    request: str
    outcome: Outcome
    output: str = ""
    results: tuple[Dependency, ...] = ()
    kept: "ModelRecord | None" = None
    dependencies: tuple[Dependency, ...] = ()
    variables: Mapping[str, str | None] = field(default_factory=dict[str, "str | None"])
    time: int = 0
    message: str = ""
    diagnostics: list[Row] = field(default_factory=list[Row])
    ledger: dict[str, int] = field(default_factory=dict[str, int])
    details: Row = field(default_factory=Row)

    @property
    def standing(self) -> "ModelRecord | None":
        """The record of the results that are in their places: this one, or that of an earlier run."""
        return self if self.outcome is Outcome.CONVERTED else self.kept


class ModelResult(NamedTuple):
    """What came of a model, and whether that was known from an earlier run."""

    record: ModelRecord
    known: bool

    def report_line(self) -> str:
        """Return a line of JSON for the report."""
        record = self.record
        row = {
            "source": record.source,
            "outcome": str(record.outcome),
            "known": self.known,
            "results": [each.path for each in record.results],
            "kept": [each.path for each in record.kept.results] if record.kept else [],
            "message": record.message,
            "diagnostics": record.diagnostics,
            "ledger": record.ledger,
            **record.details,
        }
        return json.dumps(row) + "\n"


@dataclass(slots=True)
class Summary:
    """How many models met each end, and how many of these are known from an earlier run."""

    counts: Counter[Outcome] = field(default_factory=Counter[Outcome])
    known: int = 0

    def add(self, outcome: Outcome, *, known: bool = False) -> None:
        """Count a model."""
        self.counts[outcome] += 1
        self.known += known

    @property
    def exit_code(self) -> int:
        """The worst of all."""
        return max((outcome.exit_code for outcome in self.counts), default=0)

    def __str__(self) -> str:
        """In one line."""
        counts = [f"{self.counts[outcome]} {outcome}" for outcome in Outcome if self.counts[outcome]]
        total = self.counts.total()
        before = f" ({self.known} known from before)" if self.known else ""
        return f"{total} model{'' if total == 1 else 's'}{': ' if counts else ''}{', '.join(counts)}{before}"
