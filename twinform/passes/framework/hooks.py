"""Hooks around passes: statistics and their table, printed changes, and dumps of the IR as JSON.

`Reproducer`, the hook that records a failed pass, is in `compiler/reproducers.py`.
"""

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from operator import attrgetter
from time import perf_counter

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.wording import plural
from twinform.ir import Document
from twinform.ir.changes import ChangeKind, NodeChange, Sizes, changes, count_changes
from twinform.ir.record import Sourced
from twinform.passes.framework.pass_base import Pass
from twinform.passes.framework.pass_errors import PassError
from twinform.passes.framework.pipeline import PassInstrumentation, Pipeline

NOTHING = Sizes(0, 0, 0)


@dataclass(slots=True)
class PassRecord:
    """One run of one pass. `seconds` leave verification and hooks out."""

    name: str
    seconds: float = 0.0
    sizes: Sizes = NOTHING
    findings: int = 0
    entries: int = 0
    failed: bool = False


class Statistics(PassInstrumentation):
    """A record for each pass that ran, in order.

    Put it last among the hooks: the last one is nearest to the pass.
    """

    def __init__(self) -> None:
        self.records: list[PassRecord] = []
        self.started = perf_counter()
        self._before, self._findings, self._entries = 0.0, 0, 0

    @property
    def seconds(self) -> float:
        """The time since this object was made: passes and all else."""
        return perf_counter() - self.started

    def before(self, step: Pass, document: Document, sink: DiagnosticSink) -> None:
        """Start the clock."""
        del step, document
        self._findings, self._entries = _count_findings(sink), len(sink.entries)
        self._before = perf_counter()

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        """Stop the clock before counting what changed."""
        seconds = perf_counter() - self._before
        self.records.append(PassRecord(step.name, seconds, count_changes(old, new)))
        self._count(sink)

    def failed(self, step: Pass, error: PassError, sink: DiagnosticSink) -> None:
        """Mark the pass as failed; record it first if it raised before `after` was called."""
        if isinstance(error.__cause__, Exception) or not self.records or self.records[-1].name != step.name:
            self.records.append(PassRecord(step.name, perf_counter() - self._before))
            self._count(sink)
        self.records[-1].failed = True

    def _count(self, sink: DiagnosticSink) -> None:
        self.records[-1].findings = _count_findings(sink) - self._findings
        self.records[-1].entries = len(sink.entries) - self._entries


def _count_findings(sink: DiagnosticSink) -> int:
    return len(sink.diagnostics) + sink.left_out


# Values of the IR and no diff of the text: between the passes of legalisation a document is half in
# one format and half in the other, and there is no such text. Values also tell what is absent from
# what has its default.
class PrintChanges(PassInstrumentation):
    """Writes what each pass changed: one line for each value, with its path in the IR."""

    def __init__(self, write: Callable[[str], None]) -> None:
        """`write` gets the lines about one pass, without a line end behind the last."""
        self._write = write

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        """Write the changes, if there are any."""
        del sink
        lines = list(map(line_of, changes(old, new)))
        if lines:
            self._write("\n".join([f"{Pipeline((step,))}: {_counted(old, new)}", *lines]))


def _counted(old: Document, new: Document) -> str:
    words = zip(("changed", "added", "removed"), count_changes(old, new), strict=True)
    return ", ".join(f"{plural(count, 'node')} {word}" for word, count in words if count)


def line_of(change: NodeChange) -> str:
    """A change as `sign path: old -> new`."""
    start = f"  {change.how} {change.path}"
    match change.how:
        case ChangeKind.REORDERED:
            return f"{start}: now in the order {' '.join(_items(change.new))}"
        case ChangeKind.CHANGED:
            return f"{start}: {_show_value(change.old)} -> {_show_value(change.new)}"
        case _ if change.is_node:
            return start
        case _:
            return f"{start}: {_show_value(change.old if change.how is ChangeKind.REMOVED else change.new)}"


def _items(labels: object) -> Iterator[str]:
    if isinstance(labels, list):
        yield from map(str, labels)  # pyright: ignore[reportUnknownArgumentType] - labels are text


def _show_value(value: object) -> str:
    """A value as in the JSON of a document."""
    import json  # noqa: PLC0415 - few runs are watched

    if value is None:
        return "not set"
    if isinstance(value, Sourced):
        return value.model_dump_json(exclude_defaults=True)
    return json.dumps(value, default=str, ensure_ascii=False)


_COUNTS = ("changed", "added", "removed", "findings", "ledger")
_TIMES = ("ms", "%")
_OTHERS = "all else: reading, checking, watching, what is remembered, writing"


def table(statistics: Statistics, *, times: bool) -> str:
    """The table of `--time-passes` and `--pass-statistics`: a line for each pass and one for the sums."""
    records, seconds = statistics.records, statistics.seconds
    whole = PassRecord("all passes", sum(map(attrgetter("seconds"), records)), _sizes(records))
    whole.findings, whole.entries = sum(each.findings for each in records), sum(each.entries for each in records)
    rows = [[*_TIMES[: 2 * times], *_COUNTS, "pass"]]
    rows += [_row(each, seconds, times=times) for each in (*records, whole)]
    if times:
        rest = seconds - whole.seconds
        rows.append([*_time(rest, seconds), *[""] * len(_COUNTS), _OTHERS])
    return "\n".join(_aligned(rows))


def _sizes(records: Iterable[PassRecord]) -> Sizes:
    return Sizes(*map(sum, zip((0, 0, 0), *(each.sizes for each in records), strict=True)))


def _row(record: PassRecord, seconds: float, *, times: bool) -> list[str]:
    counts = map(str, (*record.sizes, record.findings, record.entries))
    time = _time(record.seconds, seconds) if times else []
    return [*time, *counts, f"{record.name}{' (failed)' if record.failed else ''}"]


def _time(seconds: float, whole: float) -> list[str]:
    return [f"{1000 * seconds:.2f}", f"{100 * seconds / whole if whole else 0:.1f}"]


def _aligned(rows: Sequence[Sequence[str]]) -> Iterator[str]:
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for *numbers, name in rows:
        yield "  ".join([*(f"{text:>{width}}" for text, width in zip(numbers, widths, strict=False)), name])


class Dumps(PassInstrumentation):
    """Writes the document after each pass of some names, even if invalid; `seen` names all passes that ran."""

    def __init__(self, names: Collection[str], write: Callable[[str, str], None]) -> None:
        """`write` gets the name of a pass and the JSON of the document after it."""
        self._names, self._write = names, write
        self.seen: list[str] = []

    def after(self, step: Pass, old: Document, new: Document, sink: DiagnosticSink) -> None:
        """Write the document if the pass is one of those names."""
        del old, sink
        self.seen.append(step.name)
        if step.name in self._names:
            self._write(step.name, new.model_dump_json(indent=2, exclude_defaults=True))
