"""This tree beside an older one: `python -m benchmarks.before CHECKOUT [--every N] [--times N]`.

Every file of the corpus is converted both ways by the package of both checkouts, one after the other, each in a process
of its own. Said is whether text, findings and ledger are the same bytes, and how much CPU time each takes: the least of
several times for each file, and the sums of these. The processes take turns, so that whatever else the machine does
slows both.
"""

import argparse
import subprocess
import sys
from collections import defaultdict
from dataclasses import dataclass, field
from pathlib import Path

from benchmarks.converting import SDF_VERSION
from benchmarks.markdown import table
from tests.corpus.files import CORPUS, MISSING, CorpusFile, Kind, models

_SHOWN = 20
"""So many files that differ are named."""
_WORKER = f"""
import hashlib, sys, time
sys.path.insert(0, ".")
import twinform
for line in sys.stdin:
    to, path = line.rstrip("\\n").split(" ", 1)
    version = {{"sdf_version": {SDF_VERSION!r}}} if to == "sdf" else {{}}
    start = time.process_time()
    try:
        made = twinform.convert(path, to=to, **version)
        taken = time.process_time() - start
        said = "\\n".join([made.text, *map(str, made.diagnostics), *map(str, made.ledger.entries)])
    except twinform.CompileError as error:
        taken, said = -1.0, "\\n".join(map(str, error.diagnostics))
    except Exception as error:
        taken, said = -1.0, repr(error)
    print(taken, hashlib.sha256(said.encode()).hexdigest(), flush=True)
"""


@dataclass(frozen=True, slots=True)
class Checkout:
    """The package of a folder, in a process that converts what it is asked to."""

    name: str
    process: "subprocess.Popen[str]"

    @classmethod
    def at(cls, name: str, folder: Path) -> "Checkout":
        """The process of a checkout, started."""
        command = [sys.executable, "-c", _WORKER]
        pipe = subprocess.PIPE
        return cls(name, subprocess.Popen(command, cwd=folder, stdin=pipe, stdout=pipe, text=True))

    def convert(self, path: Path, to: str) -> tuple[float, str]:
        """The CPU time in seconds, below 0 where the file is refused, and a hash of all that came out."""
        if self.process.stdin is None or self.process.stdout is None:
            raise ValueError("the process has no pipes")
        self.process.stdin.write(f"{to} {path}\n")
        self.process.stdin.flush()
        taken, said = self.process.stdout.readline().split()
        return float(taken), said


@dataclass(slots=True)
class Figures:
    """What was seen of one direction."""

    differ: list[str] = field(default_factory=list[str])
    files: int = 0
    converted: int = 0
    seconds: dict[str, float] = field(default_factory=lambda: defaultdict[str, float](float))


def main(arguments: list[str] | None = None) -> int:
    """Convert with both and print what differs; 1 where something does."""
    parser = argparse.ArgumentParser(prog="benchmarks.before", description=__doc__)
    parser.add_argument("checkout", type=Path, help="the folder of the older tree")
    parser.add_argument("--every", type=int, default=1, help="one of so many files of the corpus")
    parser.add_argument("--times", type=int, default=3, help="how often each file is converted")
    options = parser.parse_args(arguments)
    if not CORPUS.is_dir():
        print(MISSING, file=sys.stderr)
        return 2
    both = (Checkout.at("before", options.checkout), Checkout.at("now", Path.cwd()))
    figures: dict[str, Figures] = defaultdict(Figures)
    for file in list(models())[:: options.every]:
        to = "sdf" if file.kind is Kind.URDF else "urdf"
        _measure(file, to, both, figures[to], options.times)
    _report(figures)
    return int(any(each.differ for each in figures.values()))


def _measure(file: CorpusFile, to: str, both: tuple[Checkout, ...], figures: Figures, times: int) -> None:
    taken: dict[str, list[float]] = defaultdict(list)
    said: dict[str, str] = {}
    for _ in range(times):
        for checkout in both:
            seconds, said[checkout.name] = checkout.convert(file.path, to)
            taken[checkout.name].append(seconds)
    figures.files += 1
    if len({*said.values()}) > 1:
        figures.differ.append(file.name)
    if all(min(each) >= 0 for each in taken.values()):
        figures.converted += 1
        for name, each in taken.items():
            figures.seconds[name] += min(each)


def _report(figures: dict[str, Figures]) -> None:
    rows = [
        [
            f"to {to.upper()}",
            str(each.files),
            str(each.files - len(each.differ)),
            str(each.converted),
            f"{each.seconds['before']:.2f} s",
            f"{each.seconds['now']:.2f} s",
            f"{each.seconds['before'] / each.seconds['now']:.2f}" if each.seconds["now"] else "",
        ]
        for to, each in figures.items()
    ]
    print(table(["", "files", "the same bytes", "both convert", "before", "now", "times as fast"], rows))
    for to, each in figures.items():
        for name in each.differ[:_SHOWN]:
            print(f"to {to.upper()}, not the same: {name}")


if __name__ == "__main__":
    sys.exit(main())
