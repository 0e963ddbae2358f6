"""Throughput of `twinform batch`, runs that are killed, and what a million models would take."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from reports.batch.runs import Cost, Folder, killed, killed_on_a_cluster, run
from reports.harness.needs import corpus
from reports.harness.pages import section, table
from reports.harness.report import Findings, Report
from reports.harness.sample import Sample
from tests.corpus.files import CORPUS
from twinform.compiler.batch import of_folder

_TIMES = 10
_KILLED_WORKERS = 5
_LEAST_SPEEDUP = 1.8
_MOST_SECONDS = 4.0
_MILLION = 1_000_000
_ABOUT = """\
Every file of the corpus that `twinform batch` takes for a model is converted to SDF: by one worker and by two, then
again where nothing has changed, then in runs that are killed. Seconds of processors are those of the whole machine's
accounting, so other work on it changes them little; seconds on the clock are right only where it had nothing else to
do, which the load shows. *Own* is the process that plans and writes; *workers* are the others, with their start. The
speed-up of two workers is what one worker has to do over what the busiest processor has to do then."""


@dataclass(frozen=True, slots=True)
class _Measured:
    """What the runs cost over so many models."""

    models: int
    one: Cost
    two: Cost
    idle: Cost
    empty: Cost
    read: int
    written: int
    manifest: int
    entry_bytes: int

    @property
    def speedup(self) -> float:
        """Of two workers, where each process has a processor."""
        return self.one.children / max(self.two.children / 2, self.two.own)

    @property
    def speedup_on_two(self) -> float:
        """Of two workers on two processors, which also plan and write."""
        return self.one.children / max((self.two.children + self.two.own) / 2, self.two.own)

    @property
    def worker(self) -> float:
        """Seconds of a worker for a model."""
        return self.two.children / self.models

    @property
    def own(self) -> float:
        """Seconds of the process that plans and writes for a model, without its start."""
        return (self.two.own - self.empty.own) / self.models


def measure(sample: Sample) -> Findings:
    """Run everything."""
    with TemporaryDirectory() as place:
        entries = of_folder(CORPUS)[:: sample.every]
        names = Path(place, "names")
        names.write_bytes(b"\0".join(os.fsencode(entry.path) for entry in entries) + b"\0")
        folder = Folder(Path(place), names)
        found = _measured(folder, [entry.path for entry in entries])
        kills = list(_killed(folder, found, sample.seed))
    faults = [f"{what}: {verdict}" for what, verdict in kills if verdict != "the same bytes"]
    if found.speedup < _LEAST_SPEEDUP:
        faults.append(f"two workers are {found.speedup:.2f} times one")
    if found.idle.own > _MOST_SECONDS:
        faults.append(f"a run of nothing to do takes {found.idle.own:.1f} seconds")
    costs, plan = _costs(found), _plan(found)
    sections = [section("Throughput", costs), section("Killed", table(("run", "results"), kills)), *plan]
    return Findings(sections, costs, faults)


def _measured(folder: Folder, paths: list[str]) -> _Measured:
    one = run(folder.command("one", "--jobs", "1"))
    two = run(folder.command("two", "--jobs", "2"))
    return _Measured(
        models=len(paths),
        one=one,
        two=two,
        idle=run(folder.command("two", "--jobs", "2")),
        empty=run([*folder.command("none")[:-1], os.devnull]),
        read=sum((CORPUS / path).stat().st_size for path in paths),
        written=sum(map(len, folder.results("two").values())),
        manifest=len(folder.manifest("two")),
        entry_bytes=_memory_of_an_entry(),
    )


def _killed(folder: Folder, found: _Measured, seed: int) -> Iterator[tuple[str, str]]:
    """Each run that is killed, with what became of its results."""
    before = folder.results("one")
    yield "two workers instead of one", _verdict(before, folder.results("two"))
    shutil.rmtree(folder.place / "two")
    done = killed(folder, "killed", found.models, _TIMES, seed)
    run(folder.command("killed"))
    what = f"killed at {_TIMES} random moments, the last after {done:,} models, and resumed"
    yield what, _verdict(before, folder.results("killed"))
    killed_on_a_cluster(folder, "cluster", found.models, _KILLED_WORKERS, seed)
    what = f"on two workers of Dask, of which {_KILLED_WORKERS} times one is killed and another started"
    yield what, _verdict(before, folder.results("cluster"))


def _verdict(before: dict[str, bytes], after: dict[str, bytes]) -> str:
    others = sum(before.get(name) != after.get(name) for name in {*before, *after})
    return f"{others} of {len(before)} differ" if others else "the same bytes"


_PLANNED = """
import resource, sys
from pathlib import Path
from twinform.compiler.batch import Batch, Convert, Entry, batch
from twinform.compiler.batch.places import outputs
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
entries = [Entry(name, name) for name in (f"robots/of/some/maker/robot_{i:07}.urdf" for i in range(200_000))]
names = outputs((entry.name for entry in entries), "sdf")
lines = {entry.name: (0, i) for i, entry in enumerate(entries)}
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 // len(entries))
"""


def _memory_of_an_entry() -> int:
    """Bytes that a run keeps in memory for each model: its entry, the place of its result, its line in the manifest."""
    done = subprocess.run([sys.executable, "-c", _PLANNED], capture_output=True, text=True, check=True)
    return int(done.stdout)


def _costs(found: _Measured) -> str:
    rows = [
        _row("one worker", found.one, found.models),
        _row("two workers", found.two, found.models),
        _row("nothing to do", found.idle, found.models),
        _row("no models", found.empty, 0),
    ]
    head = ("run", "models", "on the clock, s", "own, s", "workers, s", "workers, ms a model")
    on_the_clock = found.one.wall / found.two.wall
    text = f"""
`{found.two.summary}`; then `{found.idle.summary}`.

Two workers are {found.speedup:.2f} times one where each process has a processor, {found.speedup_on_two:.2f} times on
two processors, which then also plan and write, and {on_the_clock:.2f} times on the clock of this machine, of
{os.cpu_count()} processors with a load of {os.getloadavg()[2]:.1f}. Wanted are {_LEAST_SPEEDUP}.

A run of nothing to do takes {found.idle.own:.2f} seconds of a processor and {found.idle.wall:.2f} on the clock. Wanted
are less than {_MOST_SECONDS:.0f}.
"""
    return table(head, rows) + text


def _row(name: str, cost: Cost, models: int) -> tuple[object, ...]:
    share = f"{1000 * cost.children / models:.2f}" if models else ""
    return name, models, f"{cost.wall:.1f}", f"{cost.own:.2f}", f"{cost.children:.1f}", share


def _plan(found: _Measured) -> Iterator[str]:
    """What a million models of the same kind would take."""
    worker, own, most = found.worker, found.own, found.worker / found.own
    rows = [(cores, *_duration(_MILLION * max(worker / cores, own))) for cores in (1, 2, 8, 16, 32, 64, 256)]
    text = f"""
A model like those of the corpus costs a worker {1000 * worker:.1f} ms and the process that plans and writes
{1000 * own:.2f} ms. So {most:.0f} workers keep that process busy; more of them need a run for each shard
(`--shard 1/8`), each with workers of its own.
"""
    yield section("A million models", text, table(("workers", "hours", "limited by"), _limited(rows, most)))
    times = _MILLION / found.models
    sizes = [
        ("read", _bytes(found.read), _bytes(found.read * times)),
        ("written", _bytes(found.written), _bytes(found.written * times)),
        ("manifest", _bytes(found.manifest), _bytes(found.manifest * times)),
        ("memory of the process that plans and writes", "", _bytes(found.entry_bytes * _MILLION)),
    ]
    yield section("Bytes", table(("what", "here", "a million"), sizes))
    idle = (found.idle.own - found.empty.own) * times
    first = f"""
1. **The process that plans and writes**, with more than {most:.0f} workers. Shards are the cure.
2. **The scheduler of Dask** takes about a millisecond for each job, which is the lower limit only where models are
   much smaller than those of the corpus. Shards with schedulers of their own are the cure.
3. **A run of nothing to do** asks for the status of every file: {idle / 60:.0f} minutes of a processor for a million,
   and more where each question goes to a file server. Shards divide that, too.
4. **Places for files**: a million results are as many inodes. They lie as the models do, so folders of some thousands
   stay so.
5. **The manifest** is read once, at the start. Only where each line begins stays in memory.
6. **Memory of workers**: a process gives way to a new one after 1,000 models, so that what libraries keep does not add
   up. `dask worker --lifetime` does the same there.
"""
    yield section("What breaks first", first)


def _duration(seconds: float) -> tuple[str]:
    return (f"{seconds / 3600:.1f}",)


def _limited(rows: list[tuple[int, str]], most: float) -> Iterator[tuple[object, ...]]:
    for cores, hours in rows:
        yield cores, hours, "workers" if cores < most else "planning and writing"


def _bytes(count: float) -> str:
    size, units = float(count), ["B", "kB", "MB", "GB", "TB"]
    while size >= 1000 and len(units) > 1:
        size, units = size / 1000, units[1:]
    return f"{size:.3g} {units[0]}"


REPORT = Report(
    name="batch",
    title="Many models",
    about=_ABOUT,
    measure=measure,
    needs=(corpus,),
)
