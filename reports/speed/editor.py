"""How long does an editor wait for an answer?"""

from statistics import median

from benchmarks.editor import measured
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.markdown import table

ELEMENTS = (200, 2_000, 20_000)
TARGET = 100.0
"""Milliseconds for a key in a file of 2,000 elements."""
_HELD_TO = 2_000
_NO_ANSWERS = frozenset({"findings", "check"})
_ABOUT = """\
Milliseconds between a key and the answer, through a client on standard input and output: the median and, behind it, the
longest of so many keys, each of which makes the whole text another one. *Findings* is what comes on top of the pause of
150 ms after the last key. *check* is `twinform.check` of the same text in one process, without an editor."""


def measure(sample: Sample) -> Findings:
    """Type into a file of each size; one of so many sizes where a part is asked for."""
    found = measured(ELEMENTS[:: sample.every])
    rows = [
        [f"{elements:,}", *(f"{median(each):.0f} ({max(each):.0f})" for each in times.values())]
        for elements, times in found.items()
    ]
    times = table(["elements", *next(iter(found.values()))], rows)
    answers = found.get(_HELD_TO, {}).items()
    slow = [name for name, each in answers if name not in _NO_ANSWERS and median(each) > TARGET]
    faults = [f"more than {TARGET:g} ms for a key in a file of {_HELD_TO:,} elements: {name}" for name in slow]
    return Findings([times], times, faults)


SECTION = Section("editor", _ABOUT, measure, needs=())
