"""What came of a model."""

from dataclasses import dataclass, field
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
