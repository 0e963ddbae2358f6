"""How CPU time grows with a file: each command on many parts of each kind, and the largest documents that are read.

The child is `python -m benchmarks.growth`: it reads runs as JSON and prints the seconds of each.
"""

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import log
from pathlib import Path

from benchmarks.targets import Part, Target, at_most
from testbed.corpus.files import ROOT
from testbed.growth.documents import growing_documents, write_folder
from testbed.growth.work import COMMANDS, arguments_on, run_command
from testbed.markdown import table

SIZES = (1_000, 4_000)
"""The numbers of parts at which each command is compared on each document."""
STEEPEST = 1.15
"""The exponent of time up to which growth is called linear: what is sorted takes a little more than in proportion."""
_TELLING = 0.1
"""Seconds below which a time says nothing about growth."""
_HOSTILE_SECONDS = 3
_FOLDER = "a folder of files whose meshes are missing"
_LARGE = (
    ("check", "urdf: a chain", "\n", 16_000),
    ("convert", "urdf: a chain", "\n", 16_000),
    ("diff", "sdf: models of a world", "\n", 2_000),
    ("check", _FOLDER, "\n", 1_000),
)
_HOSTILE = (
    ("check", "urdf: links of one name", "\n", 30_000),
    ("check", "urdf: numbers in one value", "", 3_000_000),
    *(
        ("check", f"urdf: {name}", "", size)
        for name in ("unknown attributes", "gazebo of nothing", "unknown elements", "empty transmissions")
        for size in (48_000, 200_000)
    ),
    ("check", "sdf: models of one name", "", 48_000),
    ("check", "sdf: models of one name", "", 200_000),
)
ABOUT = f"""\
CPU time in a process that has done the same with one part before, for documents with many parts of one kind
(`testbed/growth/documents.toml`), at {SIZES[0]:,} and {SIZES[1]:,} parts. An *exponent* of 1 is linear, 2 is quadratic;
what takes less than a tenth of a second has none."""
_ABOUT_LARGE = """\
The largest documents, each also with a quarter of its parts, and what somebody could write to keep the machine busy.
200,000 elements in one are refused; 48,000 are just not. *Parts* of a folder are files."""


@dataclass(frozen=True, slots=True)
class Growth:
    """The seconds that a command takes for a document with fewer and with more parts."""

    command: str
    document: str
    sizes: tuple[int, int]
    seconds: tuple[float, float]

    @property
    def exponent(self) -> float:
        """The power of the size by which the time grows; 0 where the time is too short to tell."""
        if self.seconds[1] < _TELLING:
            return 0
        (small, large), (less, more) = self.sizes, self.seconds
        return log(more / less) / log(large / small)


def measure(sizes: tuple[int, int], every: int) -> Part:
    """Measure each command on one of so many documents, and the largest ones."""
    names = [f"{each.format}: {each.name}" for each in growing_documents()][::every]
    found = [each for name in names for each in _measured((command, name, "\n", sizes) for command in COMMANDS)]
    large, hostile = ([next(_measured([_quartered(*run)])) for run in runs] for runs in (_LARGE, _HOSTILE))
    targets = [*_targets([*found, *large], hostile)]
    return Part("\n\n".join([_commands_table(found), _ABOUT_LARGE, _large_table(large + hostile)]), targets)


_Run = tuple[str, str, str, tuple[int, int]]
"""A command, the name of a document, its line end, and two sizes."""


def _quartered(command: str, document: str, line_end: str, size: int) -> _Run:
    return command, document, line_end, (size // 4, size)


def _measured(runs: Iterable[_Run]) -> Iterator[Growth]:
    """Measure some runs in one process."""
    asked = [*runs]
    command = [sys.executable, "-m", "benchmarks.growth"]
    done = subprocess.run(command, cwd=ROOT, input=json.dumps(asked), capture_output=True, text=True, check=True)
    for (name, document, _, sizes), seconds in zip(asked, json.loads(done.stdout), strict=True):
        yield Growth(name, document, sizes, tuple(seconds))


def _targets(found: Sequence[Growth], hostile: Sequence[Growth]) -> Iterator[Target]:
    exponents = [each.exponent for each in (*found, *hostile)]
    yield at_most("growth of CPU time with the size, exponent of all commands and documents", STEEPEST, exponents)
    yield at_most("CPU for a hostile document", _HOSTILE_SECONDS, [each.seconds[1] for each in hostile], " s")


def _commands_table(found: Sequence[Growth]) -> str:
    """A row for each command: all of its documents together, the slowest one, and the one that grows fastest."""
    rows: list[Sequence[object]] = []
    for command in COMMANDS:
        several = [each for each in found if each.command == command]
        slowest = max(several, key=lambda each: each.seconds[1])
        steepest = max(several, key=lambda each: each.exponent)
        total = sum(each.seconds[1] for each in several)
        rows.append((command, len(several), f"{total:.1f}", *_cells(slowest), *_cells(steepest)[::2]))
    head = ["command", "documents", "CPU s", "slowest", "CPU s", "exponent", "steepest", "exponent"]
    return table(head, rows)


def _cells(one: Growth) -> tuple[str, str, str]:
    return one.document, f"{one.seconds[1]:.2f}", f"{one.exponent:.2f}"


def _large_table(found: Iterable[Growth]) -> str:
    rows = [(one.command, one.document, f"{one.sizes[1]:,}", *_cells(one)[1:]) for one in found]
    return table(["command", "document", "parts", "CPU s", "exponent"], rows)


def _print_seconds() -> None:
    """Run what is asked for on standard input, and print the seconds of each."""
    documents = {f"{each.format}: {each.name}": each for each in growing_documents()}
    found: list[list[float]] = []
    for command, name, line_end, sizes in json.load(sys.stdin):
        with tempfile.TemporaryDirectory() as folder:
            found.append([])
            for size in (1, *sizes):
                if name == _FOLDER:
                    arguments = [
                        "check",
                        "--jobs",
                        "1",
                        "--no-cache",
                        str(write_folder(Path(folder) / str(size), size)),
                    ]
                else:
                    path = documents[name].write(Path(folder), size, line_end)
                    arguments = arguments_on(command, path)
                start = time.process_time()
                run_command(arguments)
                found[-1].append(time.process_time() - start)
    print(json.dumps([seconds[1:] for seconds in found]))


if __name__ == "__main__":
    _print_seconds()
