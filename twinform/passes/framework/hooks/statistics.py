"""Pass statistics: run time, number of changes, number of findings."""

from dataclasses import dataclass
from time import perf_counter

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.ir.changes import Sizes, count_changes
from twinform.passes.framework.instrumentation import PassInstrumentation
from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.pass_errors import PassError

NOTHING = Sizes(0, 0, 0)


@dataclass(slots=True)
class PassRecord:
    """One run of one pass. `seconds` are its own, without verification and without what watches it."""

    name: str
    seconds: float = 0.0
    sizes: Sizes = NOTHING
    findings: int = 0
    entries: int = 0
    failed: bool = False


class Statistics(PassInstrumentation):
    """A record for each pass that ran, in order. `seconds` go from its making, or `start`, to the end of the last pass.

    Put it last among the watches: the last one is nearest to the pass.
    """

    def __init__(self) -> None:
        self.records: list[PassRecord] = []
        self.started = perf_counter()
        self._before, self._findings, self._entries = 0.0, 0, 0

    @property
    def seconds(self) -> float:
        """The time since this was made: of the passes and of all else."""
        return perf_counter() - self.started

    def before(self, step: Pass, document: Document, sink: DiagnosticSink) -> None:
        """Start the clock."""
        del step, document
        self._findings, self._entries = _count_findings(sink), len(sink.entries)
        self._before = perf_counter()

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        """Stop the clock, and only then count."""
        seconds = perf_counter() - self._before
        self.records.append(PassRecord(step.name, seconds, count_changes(old, new)))
        self._count(sink)

    def failed(self, step: Pass, error: PassError, sink: DiagnosticSink) -> None:
        """Record the pass if it has not come to its end."""
        if isinstance(error.__cause__, Exception) or not self.records or self.records[-1].name != step.name:
            self.records.append(PassRecord(step.name, perf_counter() - self._before))
            self._count(sink)
        self.records[-1].failed = True

    def _count(self, sink: DiagnosticSink) -> None:
        self.records[-1].findings = _count_findings(sink) - self._findings
        self.records[-1].entries = len(sink.entries) - self._entries


def _count_findings(sink: DiagnosticSink) -> int:
    return len(sink.diagnostics) + sink.left_out
