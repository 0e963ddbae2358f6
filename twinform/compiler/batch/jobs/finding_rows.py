"""Findings about a model as rows of a report, and the outcome that they mean."""

from collections.abc import Iterable

from twinform.compiler.batch.record import Outcome, Row
from twinform.compiler.batch.task import Done
from twinform.compiler.conversion_error import CompileError
from twinform.diagnostics import Diagnostic, Policy, Severity
from twinform.diagnostics.reporters.json import row


def rows(diagnostics: Iterable[Diagnostic], name: str) -> list[Row]:
    """Findings about a file, without notes."""
    return [row(each, name) for each in diagnostics if each.severity > Severity.INFO]


def refused(error: CompileError, policy: Policy, name: str) -> Done:
    """A model that cannot be read or has errors."""
    outcome = Outcome.UNREADABLE if error.unreadable else Outcome.REFUSED
    return Done(outcome=outcome, message=str(error), diagnostics=rows(policy.apply(error.diagnostics), name))
