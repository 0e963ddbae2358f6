"""What does each command import, and why?"""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory

from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.imports import COMMANDS, REASONS, Imported, imported, of_libraries, packages_beside
from testbed.markdown import subsection, table

_OURS, _RUNS = "twinform", 7
_ABOUT = """\
More than half of a short command is imports. The milliseconds are those that `python -X importtime` counts, of the
clock, the least of several runs for each module. *click, lxml* is what both import, much of it from Python's own
library; *beside* is the rest. A test holds the list."""


def measure(sample: Sample) -> Findings:
    """Run each command several times, and take the least time of each module."""
    del sample
    with TemporaryDirectory() as folder:
        found = {name: _least([imported(name, Path(folder)) for _ in range(_RUNS)]) for name in COMMANDS}
    rows = [[f"twinform {name}", *_sums(each)] for name, each in found.items()]
    sums = table(["command", "ours", "ms", "click, lxml", "ms", "beside", "ms"], rows)
    faults = [
        f"{name} imports {package} for no known reason"
        for name, each in found.items()
        for package in sorted(packages_beside(each).keys() - REASONS[name].keys())
    ]
    parts = [subsection(f"twinform {name}", *_tables(name, each)) for name, each in found.items()]
    return Findings([sums, *parts], sums, faults)


def _least(runs: Sequence[Sequence[Imported]]) -> Sequence[Imported]:
    times = defaultdict[str, list[float]](list)
    for each in chain.from_iterable(runs):
        times[each.name].append(each.milliseconds)
    return [each._replace(milliseconds=min(times[each.name])) for each in runs[-1]]


def _sums(found: Sequence[Imported]) -> Iterator[str]:
    kinds = defaultdict[str, list[float]](list)
    for each in found:
        kinds[_kind(each)].append(each.milliseconds)
    for kind in (_OURS, "click, lxml", "beside"):
        yield f"{len(kinds[kind])}"
        yield f"{sum(kinds[kind]):.0f}"


def _kind(each: Imported) -> str:
    return _OURS if each.name.startswith(_OURS) else "click, lxml" if each.name in of_libraries() else "beside"


def _tables(name: str, found: Sequence[Imported]) -> Iterator[str]:
    rooms = defaultdict[str, list[float]](list)
    for each in found:
        if each.name.startswith(f"{_OURS}."):
            rooms[each.name.split(".")[1]].append(each.milliseconds)
    rows = [(room, len(times), f"{sum(times):.1f}") for room, times in sorted(rooms.items())]
    yield table(["room", "modules", "ms"], rows)
    beside = packages_beside(found)
    times = defaultdict[str, float](float)
    for each in found:
        times[each.name.partition(".")[0]] += each.milliseconds
    yield table(
        ["beside", "ms", "first imported by", "for what"],
        [
            (f"`{each}`", f"{times[each]:.1f}", f"`{by}`" if by else "a function", REASONS[name].get(each, "unknown"))
            for each, by in sorted(beside.items())
        ],
    )


SECTION = Section("imports", _ABOUT, measure, needs=())
