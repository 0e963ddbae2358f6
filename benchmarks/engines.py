"""What is timed, each in a process of its own: this compiler, lxml as the floor, and the peers that are installed."""

import os
import select
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

from testbed.corpus.files import ROOT
from twinform.testing.oracles.libsdformat import Program

LEAST = 0.05
"""So many seconds of CPU are measured in a turn, or one call where it takes longer."""
_ALLOCATOR = {name: str(2**30) for name in ("MALLOC_TRIM_THRESHOLD_", "MALLOC_MMAP_THRESHOLD_")} | {
    "MALLOC_TOP_PAD_": str(2**26)
}
"""Freed memory stays with the process: else lxml alone spends a quarter of its time on getting it back."""
_MOST_TURNS = 30
"""After so many turns a program is started anew: libsdformat returns no memory, and had 9 GB within the corpus."""
LONGEST = 300
"""So many seconds an answer is waited for."""
_PROGRAMS = Path(__file__).with_name("programs")
_LIBSDFORMAT = Program(_PROGRAMS / "convert_libsdformat.cpp", ("sdformat12",))
_URDFDOM = Program(_PROGRAMS / "read_urdfdom.cpp", ("urdfdom",))
_EXTRA = "pip install 'twinform[bench]'"


@dataclass(frozen=True, slots=True)
class Answer:
    """The CPU seconds of one call, or why there are none."""

    seconds: float = 0.0
    refused: str = ""


@dataclass(slots=True)
class Engine:
    """A program that is timed; `needs` is what to install where it is not present, `release` which one it is.

    It is started anew after `most_turns`.
    """

    name: str
    command: Callable[[], Sequence[str]]
    present: Callable[[], bool] = lambda: True
    needs: str = ""
    release: Callable[[], str] = lambda: ""
    most_turns: int | None = None
    _turns: int = field(default=0, init=False)
    _process: "subprocess.Popen[str] | None" = field(default=None, init=False)

    def ask(self, path: Path) -> Answer:
        """The time of one turn with a file; the process is started with the first, and again after a crash."""
        if self._turns == self.most_turns:
            self.close()
        self._turns += 1
        if self._process is None:
            pipe, quiet = subprocess.PIPE, subprocess.DEVNULL
            command = self.command()
            environment = {**os.environ, **_ALLOCATOR}
            self._process = subprocess.Popen(
                command, cwd=ROOT, env=environment, stdin=pipe, stdout=pipe, stderr=quiet, text=True
            )
        process = self._process
        assert process.stdin is not None
        assert process.stdout is not None
        print(path.resolve(), file=process.stdin, flush=True)
        if not select.select([process.stdout], [], [], LONGEST)[0]:
            return self._ended(f"no answer in {LONGEST} s")
        line = process.stdout.readline().strip()
        if not line:
            return self._ended("crashed")
        return Answer(refused=line[1:].strip() or "refused") if line[0] == "!" else Answer(float(line))

    def close(self) -> None:
        """End its process, if there is one."""
        if self._process is not None:
            self._process.kill()
            self._process.communicate()
            self._process = None
            self._turns = 0

    def _ended(self, why: str) -> Answer:
        self.close()
        return Answer(refused=why)


def _python(name: str) -> Sequence[str]:
    return (sys.executable, "-m", "benchmarks.worker", name, str(LEAST))


def _own_engine(name: str) -> Engine:
    return Engine(name, partial(_python, name))


def _peer(name: str, module: str, distribution: str) -> Engine:
    present = partial(_importable, module)
    return Engine(name, partial(_python, name), present, _EXTRA, partial(_release, distribution))


def _importable(module: str) -> bool:
    return find_spec(module) is not None


def _release(distribution: str) -> str:
    try:
        return version(distribution)
    except PackageNotFoundError:
        return ""


def _program(name: str, program: Program, *arguments: str) -> Engine:
    needs = f"{program.packages[0]} for pkg-config, and g++"

    def command() -> Sequence[str]:
        return (str(program.built()), str(LEAST), *arguments)

    release = partial(_packaged, program.packages[0])
    return Engine(name, command, program.can_be_built, needs, release, _MOST_TURNS)


def _packaged(package: str) -> str:
    done = subprocess.run(["pkg-config", "--modversion", package], capture_output=True, text=True, check=False)
    return done.stdout.strip()


FLOOR, LOAD, TO_SDF, TO_URDF, TO_MJCF = map(_own_engine, ("floor", "load", "to SDF", "to URDF", "to MJCF"))
LIBSDFORMAT = _program("libsdformat", _LIBSDFORMAT)
LIBSDFORMAT_ONCE = _program("libsdformat, its description read before", _LIBSDFORMAT, "--once")
READERS = (
    _program("urdfdom", _URDFDOM),
    _peer("Drake", "pydrake", "drake"),
    _peer("Pinocchio", "pinocchio", "pin"),
    _peer("yourdfpy", "yourdfpy", "yourdfpy"),
    _peer("urdf_parser_py", "urdf_parser_py", "urdf-parser-py"),
)
"""Peers that read URDF."""
PEERS = (LIBSDFORMAT, *READERS)


def present(engines: Sequence[Engine]) -> list[Engine]:
    """Those that are installed."""
    return [engine for engine in engines if engine.present()]
