"""Pass instrumentation: the interface of hooks such as timing and printed changes."""

from collections.abc import Iterable

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.pass_errors import PassError


class PassInstrumentation:
    """Is called before and after each pass, and where one fails. Does nothing until a subclass does.

    A watch must not change anything: documents are frozen, and the notes are there to be read.
    """

    def before(self, step: Pass, document: Document, sink: DiagnosticSink) -> None:
        """The pass is about to run on the document."""

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        """The pass has run; the same document twice where it changed nothing. Nobody has verified the new one yet."""

    def failed(self, step: Pass, error: PassError, sink: DiagnosticSink) -> None:
        """The pass raised, or, after `after`, what it made is not valid."""


class CombinedInstrumentation(PassInstrumentation):
    """Several as one. They nest like brackets: what is called first before a pass is called last after it.

    So the last one is nearest to the pass, which is the place for a clock.
    """

    def __init__(self, watches: Iterable[PassInstrumentation]) -> None:
        self._watches = tuple(watches)

    def before(self, step: Pass, document: Document, sink: DiagnosticSink) -> None:
        """Tell all, the first one first."""
        for each in self._watches:
            each.before(step, document, sink)

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        """Tell all, the last one first."""
        for each in reversed(self._watches):
            each.after(step, old, new, sink)

    def failed(self, step: Pass, error: PassError, sink: DiagnosticSink) -> None:
        """Tell all, the last one first."""
        for each in reversed(self._watches):
            each.failed(step, error, sink)
