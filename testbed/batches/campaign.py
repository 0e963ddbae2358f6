"""A campaign against `twinform batch convert`: models change, a run begins, something fails, results are counted."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

from testbed.batches.sources import Sources

_SETTLED_AFTER = 20
"""So many events come before a whole run."""
_PROGRAM = (sys.executable, "-P", "-c", "from twinform.cli import main; main()")
_STATE = ".twinform-batch"
_PATIENCE = 300.0
_SITE = """
import os, time
if offset := int(os.environ.get("CLOCK_OFFSET", "0")):
    real, real_ns = time.time, time.time_ns
    time.time, time.time_ns = lambda: real() + offset, lambda: real_ns() + offset * 10**9
if other := os.environ.get("OTHER_VERSION"):
    import importlib.metadata
    known = importlib.metadata.version
    importlib.metadata.version = lambda name: other if name == "twinform" else known(name)
"""
"""What a process imports at its start: it may have another clock, or think that it is of another version."""
Process = subprocess.Popen[str]


@dataclass(slots=True)
class Tally:
    """What was done and what was found."""

    events: Counter[str] = field(default_factory=Counter[str])
    kills: Counter[str] = field(default_factory=Counter[str])
    earlier: int = 0
    lost: list[str] = field(default_factory=list[str])
    stale: list[str] = field(default_factory=list[str])

    def add(self, other: "Tally") -> None:
        """Count what another campaign has done and found."""
        self.events += other.events
        self.kills += other.kills
        self.earlier += other.earlier
        self.lost += other.lost
        self.stale += other.stale


@dataclass(slots=True)
class Campaign:
    """Runs from `src` to `disk/out` in the current folder; `disk` has little space where the caller is root."""

    count: int
    chance: random.Random
    share: float = 0.05
    tally: Tally = field(default_factory=Tally)
    sources: Sources = field(init=False)
    out: Path = Path("disk/out")

    def __post_init__(self) -> None:
        self.sources = Sources(Path("src"), self.count, self.chance)

    def prepare(self) -> None:
        """Make all models, and convert them."""
        self.sources.make()
        Path("site").mkdir()
        Path("site/sitecustomize.py").write_text(_SITE)
        self.out.parent.mkdir(exist_ok=True)
        self.settle()

    def settle(self) -> None:
        """Run to the end: then every result is what its model has to become."""
        process = self.start()
        _, errors = process.communicate(timeout=_PATIENCE)
        wanted, found = self.sources.wanted(), self.results()
        wrong = {name for name in {*wanted, *found} if wanted.get(name) != found.get(name)}
        self.tally.stale += sorted(f"{name} after a whole run: {errors[-200:]}" for name in wrong)

    @contextmanager
    def event(self, name: str) -> Generator[None]:
        """Change models, let something fail, and see what became of the results of earlier runs."""
        self.sources.change(self.share)
        before = self.results()
        yield
        self.tally.events[name] += 1
        self.tally.earlier += len(before)
        wanted, after = self.sources.wanted(), self.results()
        wrong = {self.sources.result(each) for each in self.sources.wrong}
        self.tally.lost += [f"{each} after {name}" for each in before if each not in after and each not in wrong]
        others = [each for each, text in after.items() if text not in {before.get(each), wanted.get(each)}]
        self.tally.stale += [f"{each} after {name}" for each in others]

    def results(self) -> dict[str, bytes]:
        """Every result by its place, without what a kill has left beside them."""
        found = (path for path in self.out.rglob("*.*") if path.is_file() and _STATE not in path.parts)
        return {
            path.relative_to(self.out).as_posix(): path.read_bytes() for path in found if not path.name.startswith(".")
        }

    def records(self) -> int:
        """How many lines the manifest has."""
        path = self.out / _STATE / "manifest.jsonl"
        with suppress(OSError):
            return path.read_bytes().count(b"\n")
        return 0

    def start(self, *words: str, **environment: str) -> Process:
        """Start a run, in a session of its own."""
        command = [*_PROGRAM, "batch", "convert", "src", str(self.out), "--to", "sdf", "--expand-includes", "--quiet"]
        return subprocess.Popen(
            [*command, *(words or ("--jobs", "2"))],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
            env={**os.environ, **environment},
        )

    def site(self, **variables: str) -> dict[str, str]:
        """The environment of a process that has another clock or version."""
        folders = (str(Path("site").resolve()), os.environ.get("PYTHONPATH", ""))
        return {"PYTHONPATH": os.pathsep.join(filter(None, folders)), **variables}

    def wait(self, process: Process, *, part: float | None = None) -> None:
        """Wait until some of the models that have changed are done, a random part of them, or the run has ended."""
        most = round(self.share * self.count * (self.chance.random() if part is None else part))
        enough = self.records() + max(1, most)  # before its first record it may not have begun
        end = time.monotonic() + _PATIENCE
        while process.poll() is None and self.records() < enough and time.monotonic() < end:
            time.sleep(0.01)

    def finish(self, process: Process) -> str:
        """Wait for the end of a run; gives what it printed."""
        _, errors = process.communicate(timeout=_PATIENCE)
        if "Traceback" in errors:
            self.tally.stale.append(f"a traceback: {errors[-300:]}")
        return errors

    def kill_runs(self, times: int) -> None:
        """Kill a run with all its processes, or the one alone that plans and writes, and each time the next one too."""
        with self.event("runs are killed"):
            for _ in range(times):
                process = self.start("--jobs", "1")
                self.wait(process, part=self.chance.random() * 2 / times)
                time.sleep(self.chance.random() * 0.1)
                with suppress(ProcessLookupError):
                    process.kill() if self.chance.random() < 0.5 else os.killpg(process.pid, signal.SIGKILL)
                process.communicate()
                self.tally.kills["runs"] += 1

    def interrupt_run(self) -> None:
        """Press Ctrl-C."""
        with self.event("Ctrl-C"):
            process = self.start()
            self.wait(process)
            process.send_signal(signal.SIGINT)
            self.finish(process)

    def kill_workers(self, times: int) -> None:
        """Kill workers of one run, one after the other."""
        with self.event("workers are killed"):
            process = self.start("--jobs", "2", *(("--fresh",) if self.chance.random() < 0.3 else ()))
            for _ in range(times):
                self.wait(process, part=0.2)
                for worker in _workers(process.pid)[:1]:
                    with suppress(ProcessLookupError):
                        os.kill(worker, signal.SIGKILL)
                        self.tally.kills["workers"] += 1
            self.finish(process)

    def lose(self, folder: Path, name: str) -> None:
        """Take a folder away in the middle of a run, as where a disk is unmounted, and bring it back."""
        away = folder.with_name("away")
        with self.event(name):
            process = self.start()
            self.wait(process)
            folder.rename(away)
            if folder == self.sources.folder and self.chance.random() < 0.5:
                folder.mkdir()  # the place of a disk that is not mounted
            self.finish(process)
            if folder.is_dir():
                remains = [path for path in folder.rglob("*") if path.is_file()]
                self.tally.stale += [f"{path} was written elsewhere" for path in remains]
                shutil.rmtree(folder)
            away.rename(folder)

    def fill_disk(self) -> None:
        """Run on a disk that has hardly any space left."""
        with self.event("the disk is full"):
            filler = self.out.parent / "filler"
            with suppress(OSError), filler.open("wb", buffering=0) as file:
                while file.write(bytes(65536)):
                    pass
            os.truncate(filler, max(0, filler.stat().st_size - self.chance.randrange(0, 65536)))
            self.finish(self.start())
            filler.unlink()

    def turn_clock(self) -> None:
        """Run with a clock that is a day before or after that of the files."""
        with self.event("another clock"):
            offset = str(self.chance.choice((-86_400, 86_400)))
            self.finish(self.start(**self.site(CLOCK_OFFSET=offset)))

    def hurry(self) -> None:
        """Give no model enough time."""
        with self.event("a limit of time"):
            process = self.start("--jobs", "2", "--fresh", "--timeout", "0.001")
            self.wait(process, part=0.5)  # each model that is late takes a process along
            process.send_signal(signal.SIGINT)
            self.finish(process)


def _workers(parent: int) -> list[int]:
    """The processes of a pool."""
    found: list[int] = []
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError, ValueError):
            status, command = (folder / "stat").read_text(), (folder / "cmdline").read_bytes()
            if int(status.rpartition(")")[2].split()[1]) == parent and b"spawn_main" in command:
                found.append(int(folder.name))
    return found


def play(campaign: Campaign, events: Sequence[Callable[[], None]]) -> None:
    """Let one event come after the other, and a whole run after some of them and at the end."""
    for number, event in enumerate(events, start=1):
        event()
        if number % _SETTLED_AFTER == 0:
            campaign.settle()
    campaign.settle()
