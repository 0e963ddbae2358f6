"""The work on one model, in a process of its own."""

from dataclasses import dataclass, field
from pathlib import Path

from twinform.compiler.batch.record import Outcome, Row
from twinform.compiler.driver import fulfil
from twinform.compiler.errors import CompileError
from twinform.compiler.loading import Reading
from twinform.compiler.orders import Order
from twinform.compiler.reproducing import write_reproducer
from twinform.diagnostics import Diagnostic, Fate, Ledger, Policy, Severity
from twinform.diagnostics.reporters.json import row
from twinform.passes import PassError


@dataclass(frozen=True, slots=True)
class Task:
    """One model, and what is asked for."""

    path: Path
    order: Order
    reading: Reading
    policy: Policy
    faults: Path
    """The folder for what makes the faults of passes come again."""


@dataclass(frozen=True, slots=True)
class Done:
    """What came of it."""

    outcome: Outcome
    text: str = ""
    message: str = ""
    diagnostics: list[Row] = field(default_factory=list[Row])
    ledger: dict[str, int] = field(default_factory=dict[str, int])
    entries: str = ""
    """The whole ledger as `--ledger` writes it."""


def work(task: Task) -> Done:
    """Convert a model; no fault of it, of a pass or of ours gets out."""
    try:
        return _converted(task)
    except PassError as error:
        return Done(Outcome.FAILED, message=f"{error}; {_reproducer(error, task)}")
    except Exception as error:  # noqa: BLE001 - one bad model never stops the rest
        return Done(Outcome.FAILED, message=f"a fault of twinform: {type(error).__name__}: {error}")


def _converted(task: Task) -> Done:
    name = str(task.path)
    try:
        made = fulfil(task.order, task.path, task.reading, name=name)
    except CompileError as error:
        outcome = Outcome.UNREADABLE if error.unreadable else Outcome.REFUSED
        return Done(outcome, message=str(error), diagnostics=_rows(task.policy.apply(error.diagnostics), name))
    seen = task.policy.apply(made.diagnostics)
    if any(each.is_error for each in seen):
        return Done(Outcome.REFUSED, message=str(CompileError(seen)), diagnostics=_rows(seen, name))
    counts, entries = _counts(made.ledger), made.ledger.to_json()
    return Done(Outcome.CONVERTED, made.text, diagnostics=_rows(seen, name), ledger=counts, entries=entries)


def _rows(diagnostics: tuple[Diagnostic, ...], name: str) -> list[Row]:
    return [row(each, name) for each in diagnostics if each.severity > Severity.INFO]


def _counts(ledger: Ledger) -> dict[str, int]:
    return {"expressed": ledger.expressed, **{str(fate): ledger.count(fate) for fate in Fate}}


def _reproducer(error: PassError, task: Task) -> str:
    try:
        path = write_reproducer(error, str(task.path), task.faults)
    except (OSError, TypeError, ValueError) as problem:
        return f"nothing could be written that makes it come again: {problem}"
    return f"to see it again: twinform reproduce {path}"
