"""Runs of `twinform batch convert` over the corpus, in processes of their own, and what they cost."""

import os
import random
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Generator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from tests.corpus.files import CORPUS

PROGRAM = (sys.executable, "-c", "from twinform.cli import main; main()")
_STATE = ".twinform-batch"


@dataclass(frozen=True, slots=True)
class Cost:
    """Seconds on the clock and of processors: of the command itself, and of all that it started."""

    summary: str
    wall: float
    own: float
    children: float


@dataclass(frozen=True, slots=True)
class Folder:
    """The models of a run and its results, in a folder that is thrown away."""

    place: Path
    names: Path

    def command(self, out: str, *words: str) -> list[str]:
        """The command that converts them all to SDF."""
        names = ("--names", str(self.names))
        return [
            *PROGRAM,
            "batch",
            "convert",
            str(CORPUS),
            str(self.place / out),
            "--to",
            "sdf",
            "--quiet",
            *names,
            *words,
        ]

    def results(self, out: str) -> dict[str, bytes]:
        """Every result by its place."""
        found = (path for path in (self.place / out).rglob("*") if path.is_file() and _STATE not in path.parts)
        return {path.relative_to(self.place / out).as_posix(): path.read_bytes() for path in found}

    def manifest(self, out: str) -> bytes:
        """The manifest of a run."""
        path = self.place / out / _STATE / "manifest.jsonl"
        return path.read_bytes() if path.is_file() else b""

    def records(self, out: str) -> int:
        """How many models are done."""
        return self.manifest(out).count(b"\n")


_MEASURED = """
import os, resource, sys, time
from twinform.cli import main
start = time.perf_counter()
try:
    main(sys.argv[1:])
finally:
    wall = time.perf_counter() - start
    uses = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    print("cost", wall, *(use.ru_utime + use.ru_stime for use in uses))
"""


def run(command: Sequence[str]) -> Cost:
    """Run a command to its end."""
    start = time.perf_counter()
    words = [sys.executable, "-c", _MEASURED, *command[len(PROGRAM) :]]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    wall = time.perf_counter() - start
    _, _, own, children = done.stdout.splitlines()[-1].split()
    return Cost(done.stderr.splitlines()[-1], wall, float(own), float(children))


def killed(folder: Folder, out: str, total: int, times: int, seed: int) -> int:
    """Start a run and kill it with all its processes, at so many random moments; gives how much was done by then."""
    for moment in sorted(random.Random(seed).sample(range(1, total), times)):
        process = subprocess.Popen(folder.command(out), stderr=subprocess.DEVNULL, start_new_session=True)
        _wait(lambda moment=moment, process=process: folder.records(out) >= moment or process.poll() is not None)
        kill(process)
    return folder.records(out)


def killed_on_a_cluster(folder: Folder, out: str, total: int, times: int, seed: int) -> str:
    """Run on a scheduler and two workers of Dask, of which one is killed at so many moments; gives the summary."""
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        port = str(found.getsockname()[1])
    address = f"tcp://127.0.0.1:{port}"
    worker = (
        "worker",
        address,
        "--nthreads",
        "1",
        "--no-dashboard",
        "--local-directory",
        str(folder.place / "scratch"),
    )
    with ExitStack() as stack:
        stack.enter_context(started("scheduler", "--host", "127.0.0.1", "--port", port, "--no-dashboard"))
        workers = [stack.enter_context(started(*worker)) for _ in range(2)]
        process = subprocess.Popen(folder.command(out, "--scheduler", address), stderr=subprocess.PIPE, text=True)
        for moment in sorted(random.Random(seed).sample(range(1, total), times)):
            _wait(lambda moment=moment: folder.records(out) >= moment or process.poll() is not None)
            kill(workers.pop(0))
            workers.append(stack.enter_context(started(*worker)))
        return process.communicate()[1].splitlines()[-1]


@contextmanager
def started(*words: str) -> Generator[subprocess.Popen[bytes]]:
    """A program of Dask in a session of its own."""
    nothing = subprocess.DEVNULL
    command = [sys.executable, "-m", "dask", *words]
    with subprocess.Popen(command, stdout=nothing, stderr=nothing, start_new_session=True) as process:
        try:
            yield process
        finally:
            kill(process)


def kill(process: subprocess.Popen[bytes]) -> None:
    """End a process and all that it started."""
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def _wait(condition: Callable[[], bool]) -> None:
    while not condition():
        time.sleep(0.05)
