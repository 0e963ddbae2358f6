"""The conversion of one model of a batch, in a process of its own."""

from dataclasses import dataclass, field, replace
from pathlib import Path

from twinform.compiler.batch.files import alone
from twinform.compiler.batch.manifest import digest, is_unchanged
from twinform.compiler.batch.record import Outcome, Record, Row
from twinform.compiler.driver import run_conversion
from twinform.compiler.errors import CompileError
from twinform.compiler.input.limits import LARGEST
from twinform.compiler.input.loading import XACRO, LoadOptions
from twinform.compiler.input.regular_files import read_regular
from twinform.compiler.reproducers.files import write_reproducer
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import Diagnostic, Fate, Ledger, Policy, Severity
from twinform.diagnostics.reporters.json import row
from twinform.passes import PassError


@dataclass(frozen=True, slots=True)
class Task:
    """One model, and what is asked for."""

    path: Path
    request: ConversionRequest
    load_options: LoadOptions
    policy: Policy
    faults: Path
    """The folder for what makes the faults of passes come again."""
    known: Record | None = None
    """What came of it in an earlier run, if that counts as long as neither model nor result have changed."""
    dest: Path = Path()
    """The folder of the results."""


@dataclass(frozen=True, slots=True)
class Done:
    """What came of it; `known` says that it is what was known, and nothing was done.

    `digest` is that of the model, and `alone` says whether the model is one file.
    """

    outcome: Outcome
    text: str = ""
    message: str = ""
    diagnostics: list[Row] = field(default_factory=list[Row])
    ledger: dict[str, int] = field(default_factory=dict[str, int])
    entries: str = ""
    """The whole ledger as `--ledger` writes it."""
    digest: str = ""
    alone: bool = True
    known: bool = False


def work(task: Task) -> Done:
    """Convert a model; no fault of it, of a pass or of ours gets out."""
    try:
        content = read_regular(task.path, LARGEST + 1)
    except OSError as error:
        return Done(Outcome.UNREADABLE, message=f"it cannot be read: {error.strerror}")
    made, single = digest(content), alone(task.path, content)
    if task.known and single and _holds(task.known, made, task.dest):
        return Done(task.known.outcome, known=True)
    return replace(_worked(task, content), digest=made, alone=single)


def _holds(known: Record, made: str, dest: Path) -> bool:
    """Whether what is known of a model is still so, and its result still there."""
    if known.digest != made:
        return False
    return known.outcome is not Outcome.CONVERTED or is_unchanged(dest / known.output, known.made)


def _worked(task: Task, content: bytes) -> Done:
    try:
        return _converted(task, content)
    except PassError as error:
        return Done(Outcome.FAILED, message=f"{error}; {_reproducer(error, task)}")
    except Exception as error:  # noqa: BLE001 - one bad model never stops the rest
        return Done(Outcome.FAILED, message=f"a fault of twinform: {type(error).__name__}: {error}")


def _converted(task: Task, content: bytes) -> Done:
    name = str(task.path)
    source = task.path if task.path.suffix.lower() == XACRO else content  # expanding it needs the path
    try:
        made = run_conversion(task.request, source, task.load_options, name=name)
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
