"""Up to 100,000 links: CPU time for a link and peak memory, each in a process of its own.

The child is `python -m benchmarks.scale FILE TO OUTPUT`: it converts one file and prints what that took as JSON.
"""

import json
import resource
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

import twinform
from benchmarks import inputs
from benchmarks.targets import Part, Target, at_most
from testbed import robots
from testbed.corpus.files import ROOT
from testbed.markdown import subsection, table

SIZES = (1_000, 10_000, 100_000)
LINEAR = 1.5
"""So many times as much for a link at the largest size as at the smallest is still called linear."""
MEMORY_GB = 3
_LIFTED = {"max_size": 2**32, "max_tags": 2**32}
"""The options that lift the limits on input."""
_ABOUT = f"""\
Each conversion is the only one of its process, after one of ten links; the limits on size are lifted. *Peak* is the
most memory that the process had. Linear is at most {LINEAR} times as much CPU for a link as at {SIZES[0]:,} links."""


@dataclass(frozen=True, slots=True)
class Run:
    """A conversion of a generated robot: what it took, or why it was refused."""

    shape: str
    to: str
    links: int
    seconds: float = 0.0
    gigabytes: float = 0.0
    refused: str = ""

    @property
    def per_link(self) -> float | None:
        """Seconds of CPU for a link."""
        return None if self.refused else self.seconds / self.links


def measure(sizes: Sequence[int]) -> Part:
    """Convert trees and chains of these sizes to SDF and back."""
    runs = [run for shape in ("tree", "chain") for links in sizes for run in _there_and_back(shape, links)]
    runs.sort(key=lambda run: (run.shape != "tree", run.to, run.links))
    return Part(subsection("A hundred thousand links", _ABOUT, runs_table(runs)), list(targets(runs)))


def _there_and_back(shape: str, links: int) -> Iterator[Run]:
    source = inputs.generated(shape, links).path
    target, back = source.with_suffix(".sdf"), source.with_suffix(".back.urdf")
    yield _run(Run(shape, "SDF", links), source, target)
    yield _run(Run(shape, "URDF", links), target, back)


def _run(run: Run, source: Path, target: Path) -> Run:
    if not source.is_file():
        return Run(run.shape, run.to, run.links, refused="there is no SDF of it")
    target.unlink(missing_ok=True)
    command = [sys.executable, "-m", "benchmarks.scale", str(source), run.to.lower(), str(target)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        return Run(run.shape, run.to, run.links, refused=(done.stderr.strip() or "killed").splitlines()[-1])
    return Run(run.shape, run.to, run.links, **json.loads(done.stdout))


def runs_table(runs: Iterable[Run]) -> str:
    """A row for each run, those of one shape and direction together."""
    head = ["robot", "to", "links", "CPU s", "us per link", "times the first", "peak GB"]
    rows: list[Sequence[object]] = []
    for _, group in groupby(runs, key=lambda run: (run.shape, run.to)):
        several = list(group)
        rows += [_row(run, growth(several[0], run)) for run in several]
    return table(head, rows)


def _row(run: Run, times: float | None) -> Sequence[object]:
    if run.per_link is None:
        return run.shape, run.to, f"{run.links:,}", "refused", "", "", run.refused
    grown = "" if times is None else f"{times:.2f}"
    seconds, link = f"{run.seconds:.3g}", f"{run.per_link * 1e6:.0f}"
    return run.shape, run.to, f"{run.links:,}", seconds, link, grown, f"{run.gigabytes:.2f}"


def growth(first: Run, run: Run) -> float | None:
    """How many times as much a link takes as in another run."""
    return None if not first.per_link or run.per_link is None else run.per_link / first.per_link


def targets(runs: Sequence[Run]) -> Iterator[Target]:
    """What the figures of this part are held to."""
    largest = max((run.links for run in runs), default=0)
    firsts = {(run.shape, run.to): run for run in reversed(runs)}
    grown = [growth(firsts[run.shape, run.to], run) for run in runs if run.links == largest]
    yield at_most(f"CPU for a link at {largest:,} links, in times of the least", LINEAR, grown)
    peaks = [None if run.refused else run.gigabytes for run in runs if run.links == largest]
    yield at_most(f"peak memory at {largest:,} links", MEMORY_GB, peaks, " GB")


def convert_once(source: str, to: Any, target: str) -> None:
    """Convert a file and print what it took."""
    small = twinform.convert(robots.urdf(10).encode(), name="small.urdf", to="sdf").text
    twinform.convert(small.encode(), name="small.sdf", to="urdf")
    lifted: dict[str, Any] = {**_LIFTED}
    start = time.process_time()
    try:
        made = twinform.convert(source, to=to, **lifted)
    except twinform.CompileError as error:
        sys.exit(next((each.message for each in error.diagnostics if each.is_error), str(error)))
    seconds = time.process_time() - start
    peak = peak_gigabytes()
    Path(target).write_text(made.text, encoding="utf-8")
    print(json.dumps({"seconds": seconds, "gigabytes": peak}))


def peak_gigabytes() -> float:
    """The most memory that this process has had; what getrusage says may be that of the process before exec."""
    status = Path("/proc/self/status")
    lines = status.read_text(encoding="utf-8").splitlines() if status.is_file() else []
    kilobytes = next((int(line.split()[1]) for line in lines if line.startswith("VmHWM:")), None)
    return (kilobytes or resource.getrusage(resource.RUSAGE_SELF).ru_maxrss) * 1024 / 1e9


if __name__ == "__main__":
    convert_once(*sys.argv[1:])
