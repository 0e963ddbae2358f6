"""What came of each model of a batch."""

import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import field
from enum import StrEnum
from typing import NamedTuple

from twinform.compiler.dependencies import Dependency
from twinform.dataclass import dataclass
from twinform.diagnostics.wording import plural

Row = dict[str, object]


class Outcome(StrEnum):
    """The end that the work on a model came to."""

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
        """The exit code of the command if one model has this outcome."""
        return _CODES.get(self, 1)

    @property
    def is_good(self) -> bool:
        """Whether there is nothing to report."""
        return self.exit_code == 0

    @property
    def is_final(self) -> bool:
        """Whether the work would end the same way again, as long as nothing changes."""
        return self in _FINAL


_GOOD = (Outcome.CONVERTED, Outcome.ACCEPTED, Outcome.MEASURED, Outcome.SAME)
_FINAL = frozenset({*_GOOD, Outcome.DIFFERENT, Outcome.REFUSED, Outcome.UNREADABLE})
_CODES = {**dict.fromkeys(_GOOD, 0), Outcome.UNREADABLE: 2, Outcome.UNWRITTEN: 2}


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelRecord:
    """What came of a model, as the manifest keeps it.

    `request` is the digest of the request. `results` are the files that were written; `dependencies` and `variables`
    are what the work depended on, noted at `time` in nanoseconds. Without dependencies the work is done again.
    `kept` is the record of results of an earlier run, which stay in place until there is a verdict on the model; it
    counts again as soon as everything is as it was then. `message` says why there is no result. `diagnostics` are rows
    as in `check --format json`, `ledger` counts the fates of the parts of the model, and `details` are statistics or
    differences.
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
        """The record whose results are in place: this one, or that of an earlier run."""
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
    """How many models have each outcome, and how many outcomes were known from an earlier run."""

    counts: Counter[Outcome] = field(default_factory=Counter[Outcome])
    known: int = 0

    def add(self, outcome: Outcome, *, known: bool = False) -> None:
        """Count a model."""
        self.counts[outcome] += 1
        self.known += known

    @property
    def exit_code(self) -> int:
        """The worst exit code of all models."""
        return max((outcome.exit_code for outcome in self.counts), default=0)

    def __str__(self) -> str:
        """Return the counts in one line."""
        counts = [f"{self.counts[outcome]} {outcome}" for outcome in Outcome if self.counts[outcome]]
        total = self.counts.total()
        before = f" ({self.known} known from before)" if self.known else ""
        return f"{plural(total, 'model')}{': ' if counts else ''}{', '.join(counts)}{before}"
