"""The table of `--time-passes` and `--pass-statistics`."""

from collections.abc import Iterable, Iterator, Sequence
from operator import attrgetter

from twinform.ir.changes import Sizes
from twinform.passes.framework.hooks.statistics import PassRecord, Statistics

_COUNTS = ("changed", "added", "removed", "findings", "ledger")
_TIMES = ("ms", "%")
_OTHERS = "all else: reading, checking, watching, what is remembered, writing"


def table(statistics: Statistics, *, times: bool) -> str:
    """A line for each pass and the sums, the widths of columns fitting; times only where they are asked for."""
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
