"""Errors of passes: an exception, or invalid IR as the result. Both are bugs of the pass, not of the model.

Commands catch these errors, and must not import Pydantic for that: `pass_base.py` does.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from twinform.diagnostics import Diagnostic
from twinform.ir import Document

if TYPE_CHECKING:
    from twinform.passes.framework.pass_base import Pass


class PassError(Exception):
    """A bug of a pass. `step` is the pass with its options, `document` its input."""

    def __init__(self, message: str, step: "Pass", document: Document) -> None:
        super().__init__(message)
        self.step, self.document = step, document

    @property
    def name(self) -> str:
        """The name of the pass."""
        return self.step.name


class FailedPassError(PassError):
    """A pass raised an exception, which is the cause of this error."""

    def __init__(self, step: "Pass", document: Document, error: Exception) -> None:
        super().__init__(f"the pass {step.name} failed: {type(error).__name__}: {error}", step, document)


class BrokenPassError(PassError):
    """A pass returned invalid IR; `problems` are the errors found in it."""

    def __init__(self, step: "Pass", document: Document, problems: Sequence[Diagnostic]) -> None:
        self.problems = tuple(problems)
        found = "; ".join(f"{each.message} [{each.rule.name}]" for each in problems)
        super().__init__(f"the pass {step.name} made an invalid document: {found}", step, document)
