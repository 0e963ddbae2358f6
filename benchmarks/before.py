"""This tree beside an older one: `python -m benchmarks.before CHECKOUT [--every N] [--times N] [--all]`.

Every file of the corpus is converted to the other format by the package of both checkouts, one after the other, each
in a process of its own. Compared are the output, byte by byte, findings with the ledger, and CPU time: the least of
several times for each file, and the sums of these. The processes take turns, so that whatever else the machine does
slows both.

With `--all` each file is also converted to its own format, to JSON and without carriers, checked, checked strictly, and
converted with three passes, which are others for each file.
"""

import argparse
import json
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

from lxml import etree

from testbed.corpus.files import CORPUS, MISSING, ROOT, CorpusFile, Kind, models
from testbed.edits import passes as edit_passes
from testbed.markdown import table
from testbed.output_files import SDF_VERSION

_SHOWN = 20
"""So many files that differ are named."""
_PASSES = 3
_WRITES_FILES = "bridge-config"
_WORKER = """
import hashlib, json, sys, time
sys.path.insert(0, ".")
import twinform

def texts(diagnostics):
    keys = ("message", "location", "severity", "found", "expected", "help", "related")
    return [str([each.rule.name, *(str(getattr(each, key)) for key in keys)]) for each in diagnostics]

def entries(ledger):
    keys = ("fate", "message", "location", "weight")
    return [str([each.rule.name, *(str(getattr(each, key)) for key in keys)]) for each in ledger.entries]

for line in sys.stdin:
    path, function, options = json.loads(line)
    start = time.process_time()
    try:
        result = getattr(twinform, function)(path, **options)
        taken = time.process_time() - start
        text, findings = getattr(result, "text", ""), texts(getattr(result, "diagnostics", ()))
        if function == "convert":
            findings = [*findings, str(result.ledger.expressed), *entries(result.ledger)]
    except twinform.CompileError as error:
        taken, text, findings = -1.0, "", texts(error.diagnostics)
    except Exception as error:
        taken, text, findings = -1.0, "", [repr(error)]
    encoded = [each.encode("utf-8", "surrogatepass") for each in (text, "\\n".join(findings))]
    print(taken, *(hashlib.sha256(each).hexdigest() for each in encoded))
    sys.stdout.flush()
"""


@dataclass(frozen=True, slots=True)
class Call:
    """What is asked of both packages about one file: `kind` is the row of the table that it belongs to."""

    kind: str
    path: Path
    function: str = "convert"
    options: dict[str, object] = field(default_factory=dict[str, object])

    @property
    def line(self) -> str:
        """The call as the process reads it."""
        return json.dumps([str(self.path), self.function, self.options])

    @property
    def name(self) -> str:
        """The file and what is done with it."""
        return f"{self.path.relative_to(CORPUS)} {self.options}"


@dataclass(frozen=True, slots=True)
class Checkout:
    """The package of a folder, in a process that does what it is asked to."""

    name: str
    process: "subprocess.Popen[str]"

    @classmethod
    def at(cls, name: str, folder: Path) -> "Checkout":
        """The process of a checkout, started."""
        own = folder.resolve() / ".venv" / "bin" / "python"  # which finds the passes where this checkout has them
        python = str(own) if own.exists() else sys.executable
        pipe = subprocess.PIPE
        return cls(name, subprocess.Popen([python, "-c", _WORKER], cwd=folder, stdin=pipe, stdout=pipe, text=True))

    def answer(self, call: Call) -> tuple[float, str, str]:
        """The CPU time in seconds, below 0 where the file is refused; hashes of the output, of findings and ledger."""
        if self.process.stdin is None or self.process.stdout is None:
            raise ValueError("the process has no pipes")
        self.process.stdin.write(f"{call.line}\n")
        self.process.stdin.flush()
        taken, text, findings = self.process.stdout.readline().split()
        return float(taken), text, findings


@dataclass(slots=True)
class Figures:
    """What was seen of one kind of call."""

    other_output: list[str] = field(default_factory=list[str])
    other_findings: list[str] = field(default_factory=list[str])
    calls: int = 0
    answered: int = 0
    seconds: dict[str, float] = field(default_factory=lambda: defaultdict[str, float](float))


def main(arguments: list[str] | None = None) -> int:
    """Convert with both and print what differs; 1 where something does."""
    parser = argparse.ArgumentParser(prog="benchmarks.before", description=__doc__)
    parser.add_argument("checkout", type=Path, help="the folder of the older tree")
    parser.add_argument("--every", type=int, default=1, help="one of so many files of the corpus")
    parser.add_argument("--times", type=int, default=3, help="how often each file is converted")
    parser.add_argument(
        "--all", action="store_true", help="every conversion and check of a file, not one conversion alone"
    )
    options = parser.parse_args(arguments)
    if not CORPUS.is_dir():
        print(MISSING, file=sys.stderr)
        return 2
    files = models()[:: options.every]
    calls = (call for file in files for call in (_all_calls(file) if options.all else [_other_format(file)]))
    figures = compare(calls, options.checkout, options.times)
    _report(figures)
    return int(any(each.other_output or each.other_findings for each in figures.values()))


def compare(calls: Iterable[Call], checkout: Path, times: int) -> dict[str, Figures]:
    """What the packages of an older checkout and of this one make of each call, in turns, by kind of call."""
    both = (Checkout.at("before", checkout), Checkout.at("now", ROOT))
    figures: dict[str, Figures] = defaultdict(Figures)
    for call in calls:
        _measure(call, both, figures[call.kind], times)
    for each in both:
        each.process.communicate()
    return figures


def figures_table(figures: Mapping[str, Figures]) -> str:
    """A row for each kind of call."""
    head = ["", "calls", "same output", "same findings", "neither refuses", "before", "now", "now / before"]
    return table(head, (_row(kind, each) for kind, each in figures.items()))


def _other_format(file: CorpusFile, **options: object) -> Call:
    if file.kind is Kind.URDF:
        return Call("to SDF", file.path, options={"to": "sdf", "sdf_version": SDF_VERSION, **options})
    return Call("to URDF", file.path, options={"to": "urdf", **options})


def _all_calls(file: CorpusFile) -> Iterator[Call]:
    own = "urdf" if file.kind is Kind.URDF else "sdf"
    yield _other_format(file)
    yield Call("to its own format", file.path, options={"to": own})
    yield Call("to JSON", file.path, options={"to": "json"})
    other = _other_format(file, carriers=False)
    yield Call("without carriers", file.path, options=other.options)
    for strict in (False, True):
        yield Call("check", file.path, "check", {"strict": strict})
    random = Random(file.name)
    names = [name for name in edit_passes.NAMES if name != _WRITES_FILES]
    with suppress(etree.XMLSyntaxError):  # links to choose from are listed for files that need no repair
        chosen = [edit_passes.pipeline(name, file.path.read_bytes(), random) for name in random.sample(names, _PASSES)]
        for pipeline in filter(None, chosen):
            yield Call("with a pass", file.path, options={"to": own, "passes": pipeline})


def _measure(call: Call, both: tuple[Checkout, ...], figures: Figures, times: int) -> None:
    taken: dict[str, list[float]] = defaultdict(list)
    texts, findings = dict[str, str](), dict[str, str]()
    for _ in range(times):
        for checkout in both:
            seconds, texts[checkout.name], findings[checkout.name] = checkout.answer(call)
            taken[checkout.name].append(seconds)
    figures.calls += 1
    for seen, differing in ((texts, figures.other_output), (findings, figures.other_findings)):
        if len({*seen.values()}) > 1:
            differing.append(call.name)
    if all(min(each) >= 0 for each in taken.values()):
        figures.answered += 1
        for name, each in taken.items():
            figures.seconds[name] += min(each)


def _row(kind: str, seen: Figures) -> tuple[object, ...]:
    same = (seen.calls - len(names) for names in (seen.other_output, seen.other_findings))
    before, now = seen.seconds["before"], seen.seconds["now"]
    part = f"{now / before:.2f}" if before else ""
    return (kind, seen.calls, *same, seen.answered, f"{before:.2f} s", f"{now:.2f} s", part)


def _report(figures: dict[str, Figures]) -> None:
    print(figures_table(figures))
    for kind, each in figures.items():
        for what, names in (("output", each.other_output), ("findings", each.other_findings)):
            for name in names[:_SHOWN]:
                print(f"{kind}, other {what}: {name}")


if __name__ == "__main__":
    sys.exit(main())
