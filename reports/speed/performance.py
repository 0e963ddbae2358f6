"""How fast is it, for robots of every size, beside its peers and an older tree?

An older checkout and a folder of other robots may be given: `make bench BEFORE=../older MORE=../robots`. Nothing
fails: the page says which targets are met.
"""

from dataclasses import replace
from pathlib import Path

from benchmarks.parts import QUICK, Extent, machine, measured_parts
from benchmarks.targets import target_table
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed import robots

_ABOUT = f"""\
All figures are CPU time, of the process and for commands of the whole process with its children, the garbage collector
left as a user has it and byte code present. What is compared takes turns within one run, each in a process of its own;
a figure is the median of the turns, and in a turn a call that takes little is repeated for a twentieth of a second.
These processes keep the memory that they free, which helps lxml, the floor, more than anybody else.
Generated robots have {robots.ELEMENTS_PER_LINK} elements for each link; a link has {robots.BRANCHING} children in a
tree, and one in a chain."""


def measure(sample: Sample) -> Findings:
    """Measure all of it, or small robots and one of so many files."""
    extent = replace(QUICK, every=sample.every) if sample.every > 1 else Extent()
    before, others = [*map(Path, sample.inputs), None, None][:2]
    parts = list(measured_parts(extent, before, others))
    targets = target_table(parts)
    return Findings([targets, machine(), *(part.section for part in parts)], targets)


SECTION = Section("performance", _ABOUT, measure, needs=())
