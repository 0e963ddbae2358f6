"""Runs of `twinform batch convert` over the corpus, in processes of their own, and what they cost."""

import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from testbed.corpus.files import CORPUS

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
