"""How does the time of each command grow with the size of a file, and what do hostile files cost?"""

from benchmarks import growth
from benchmarks.parts import machine
from benchmarks.targets import target_table
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section


def measure(sample: Sample) -> Findings:
    """Measure all commands on one of so many documents, and the largest documents."""
    part = growth.measure(growth.SIZES, sample.every)
    targets = target_table([part])
    return Findings([targets, machine(), part.section], targets)


SECTION = Section("growth", growth.ABOUT, measure, needs=())
