"""How many models an hour does a batch work on, and what would a million take?"""

import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.batches.runs import Cost, Folder, run
from testbed.corpus.files import CORPUS
from testbed.markdown import subsection, table
from twinform.compiler.batch import of_folder

_LEAST_SPEEDUP = 1.8
_MOST_SECONDS = 4.0
_MILLION = 1_000_000
_ONE, _TWO = ("one", "--jobs", "1"), ("two", "--jobs", "2")
"""The folder of the results, and options."""
_ABOUT = """\
Every file of the corpus that `twinform batch` takes for a model is converted to SDF: by one worker and by two, then
again where nothing has changed. Seconds of processors are those of the whole machine's accounting, so other work on it
changes them little; seconds on the clock are right only where it had nothing else to do, which the load shows. *Own* is
the process that plans and writes; *workers* are the others, with their start. The speed-up of two workers is what one
worker has to do over what the busiest processor has to do then."""
_PLANNED = """
import resource, sys
from pathlib import Path
from twinform.compiler.batch import Batch, Convert, ModelEntry, batch
from twinform.compiler.batch.entries import outputs
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
entries = [ModelEntry(name, name) for name in (f"robots/of/some/maker/robot_{i:07}.urdf" for i in range(200_000))]
names = outputs((entry.name for entry in entries), "sdf")
lines = {entry.name: (0, i) for i, entry in enumerate(entries)}
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 // len(entries))
"""
"""Prints the bytes that a run keeps in memory for a model: its entry, the place of its result, its line in the
manifest."""


@dataclass(frozen=True, slots=True)
class _Costs:
    """What the runs cost over so many models, and the bytes that were read, written and recorded."""

    models: int
    one: Cost
    two: Cost
    idle: Cost
    empty: Cost
    megabytes: dict[str, float]

    @property
    def speedup(self) -> float:
        """Of two workers, where each process has a processor."""
        return self.one.children / max(self.two.children / 2, self.two.own)

    @property
    def worker(self) -> float:
        """Seconds of a worker for a model."""
        return self.two.children / self.models

    @property
    def own(self) -> float:
        """Seconds of the process that plans and writes for a model, without its start."""
        return (self.two.own - self.empty.own) / self.models


def measure(sample: Sample) -> Findings:
    """Convert with one worker, with two, and once more."""
    with TemporaryDirectory() as place:
        found = _costs(Path(place), [entry.path for entry in of_folder(CORPUS)[:: sample.every]])
    faults = [f"two workers are {found.speedup:.2f} times one"] if found.speedup < _LEAST_SPEEDUP else []
    if found.idle.own > _MOST_SECONDS:
        faults.append(f"a run of nothing to do takes {found.idle.own:.1f} seconds")
    throughput = _throughput(found)
    million = subsection("A million models", *_million(found))
    return Findings([subsection("Throughput", throughput), million], throughput, faults)


def _costs(place: Path, paths: list[str]) -> _Costs:
    names = place / "names"
    names.write_bytes(b"\0".join(map(os.fsencode, paths)) + b"\0")
    folder = Folder(place, names)
    one, two, idle = (run(folder.command(*words)) for words in (_ONE, _TWO, _TWO))
    megabytes = {
        "read": sum((CORPUS / path).stat().st_size for path in paths) / 1e6,
        "written": sum(map(len, folder.results("two").values())) / 1e6,
        "manifest": len(folder.manifest("two")) / 1e6,
    }
    return _Costs(len(paths), one, two, idle, run([*folder.command("none")[:-1], os.devnull]), megabytes)


def _throughput(found: _Costs) -> str:
    runs = {"one worker": found.one, "two workers": found.two, "nothing to do": found.idle, "no models": found.empty}
    rows = [(name, f"{cost.wall:.1f}", f"{cost.own:.2f}", f"{cost.children:.1f}") for name, cost in runs.items()]
    text = f"""
{found.two.summary}. Two workers are {found.speedup:.2f} times one where each process has a processor, wanted are
{_LEAST_SPEEDUP}; and {found.one.wall / found.two.wall:.2f} times on the clock of this machine, of {os.cpu_count()}
processors with a load of {os.getloadavg()[2]:.1f}. A run of nothing to do takes {found.idle.own:.2f} seconds of a
processor, wanted are less than {_MOST_SECONDS:.0f}.
"""
    return table(("run", "on the clock, s", "own, s", "workers, s"), rows) + text


def _million(found: _Costs) -> Iterator[str]:
    """What a million models of the same kind would take."""
    most = found.worker / found.own
    yield f"""A model like those of the corpus costs a worker {1000 * found.worker:.1f} ms and the process that plans
and writes {1000 * found.own:.2f} ms. So {most:.0f} workers keep that process busy; more of them need a run for each
shard (`--shard 1/8`), each with workers of its own."""
    hours = [(cores, f"{_MILLION * max(found.worker / cores, found.own) / 3600:.1f}") for cores in (1, 2, 8, 16, 64)]
    yield table(("workers", "hours"), hours)
    entry = subprocess.run([sys.executable, "-c", _PLANNED], capture_output=True, text=True, check=True)
    sizes = [(what, f"{size / found.models * _MILLION / 1e3:,.1f}") for what, size in found.megabytes.items()]
    memory = ("memory of the process that plans and writes", f"{int(entry.stdout) * _MILLION / 1e9:,.1f}")
    yield table(("what", "GB"), [*sizes, memory])


SECTION = Section("batch", _ABOUT, measure)
