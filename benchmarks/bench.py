"""How fast it is: `make bench`, or `python -m benchmarks.bench`. Writes docs/evidence/performance.md.

A part of it, by `--quick` or `--every`, is printed instead. It asserts nothing: the page says which targets are met.
"""

import argparse
import os
import platform
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import twinform
from benchmarks import commands, converters, inputs, real_files, robots, scale, sizes, stages
from benchmarks.engines import PEERS
from benchmarks.inputs import Robot, generated
from benchmarks.targets import Part, at_most, target_table
from reports.harness.pages import paragraphs, section, table
from tests.corpus.files import CORPUS, ROOT, Kind

PAGE = ROOT / "docs" / "evidence" / "performance.md"
PROFILED = 1_000
BARE = "python -c pass"
COMMAND_LIMITS = {"check": 120, "convert": 180}
_TITLE = "# How fast it is\n\nMade by `make bench`."
_ABOUT = f"""\
All figures are CPU time, of the process and for commands of the whole process with its children, the garbage collector
left as a user has it and byte code present. What is compared takes turns within one run, each in a process of its own;
a figure is the median of the turns, and in a turn a call that takes little is repeated for a twentieth of a second.
These processes keep the memory that they free, which helps lxml, the floor, more than anybody else.
Generated robots have {robots.ELEMENTS_PER_LINK} elements for each link; a link has {robots.BRANCHING} children in a
tree, and one in a chain."""


@dataclass(frozen=True, slots=True)
class Extent:
    """How much is measured: generated robots, turns for them and for real files, and one of `every` of these."""

    trees: Sequence[int] = (10, 100, 1_000, 5_000, 10_000)
    chains: Sequence[int] = (1_000, 10_000)
    converted: Sequence[int] = (10, 100, 1_000, 5_000)
    scale: Sequence[int] = scale.SIZES
    rounds: int = 5
    corpus_rounds: int = 3
    runs: int = commands.RUNS
    every: int = 1


QUICK = Extent((10, 100, 1_000), (1_000,), (10, 100), (1_000, 10_000), 3, 3, 5, 40)


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, and write the page or print it."""
    parser = argparse.ArgumentParser(prog="benchmarks.bench", description=__doc__)
    parser.add_argument("--before", type=Path, help="the folder of an older checkout, to be measured beside this one")
    parser.add_argument("--every", type=int, help="one of so many real files")
    parser.add_argument("--quick", action="store_true", help="small robots, few files, few turns")
    parser.add_argument("--output", type=Path, help="the page, in another file")
    given = parser.parse_args(arguments)
    extent = QUICK if given.quick else Extent()
    if given.every:
        extent = replace(extent, every=given.every)
    is_whole = extent == Extent() and CORPUS.is_dir()
    parts = list(_parts(extent, given.before))
    text = paragraphs(_TITLE, target_table(parts), _ABOUT, _machine(), *(part.section for part in parts)) + "\n"
    page: Path | None = given.output or (PAGE if is_whole else None)
    if page is not None:
        twinform.write_atomically(page, text)
    print(text)
    return 0


def _parts(extent: Extent, before: Path | None) -> Iterator[Part]:
    """Each part of the page, once it is measured."""
    trees, chains = ([generated(shape, links) for links in some] for shape, some in _shapes(extent))
    yield _said(sizes.measure([*trees, *chains, *inputs.known()], extent.rounds))
    corpus = [Robot(file.name, file.path, 0) for file in inputs.corpus(extent.every, Kind.URDF)]
    made = [generated(shape, links) for shape in ("tree", "chain") for links in extent.converted]
    yield _said(converters.measure(corpus, made, extent.corpus_rounds))
    yield _said(real_files.measure(before, extent.every, extent.corpus_rounds))
    yield _said(_commands(extent.runs))
    yield _said(scale.measure(extent.scale))
    yield _said(Part(stages.page(_profiles(extent.every))))


def _shapes(extent: Extent) -> Sequence[tuple[str, Sequence[int]]]:
    return ("tree", extent.trees), ("chain", extent.chains)


def _said(part: Part) -> Part:
    print(part.section.partition("\n")[0], "is measured", file=sys.stderr, flush=True)
    return part


def _commands(runs: int) -> Part:
    with tempfile.TemporaryDirectory() as folder:
        found = commands.measured(Path(folder), [ROOT], runs)
    milliseconds = {command.name: ms for command, ms in found.items()}
    bare = milliseconds[BARE]
    targets = [
        at_most(f"{name}, over `{BARE}`", limit, [milliseconds[name] - bare], " ms")
        for verb, limit in COMMAND_LIMITS.items()
        for name in [f"twinform {verb}, {commands.LINKS} links"]
    ]
    about = f"From start to exit, the median of {runs} runs; the robot is a tree."
    rows = ((name, f"{ms:.0f}", f"{ms - bare:.0f}") for name, ms in milliseconds.items())
    return Part(section("Whole commands", about, table(["command", "CPU ms", f"over `{BARE}`"], rows)), targets)


def _profiles(every: int) -> dict[str, Mapping[str, float]]:
    """Where the time goes in a generated tree and in all real files."""
    tree = generated("tree", PROFILED)
    urdf, sdf = ([file.path for file in inputs.corpus(every, kind)] for kind in (Kind.URDF, Kind.SDF))
    found = {
        f"{tree.name} to SDF": stages.profile([tree.path], "sdf"),
        f"{tree.name} to URDF": stages.profile([inputs.in_sdf(tree)], "urdf"),
    }
    if urdf and sdf:
        found["real URDF to SDF"] = stages.profile(urdf, "sdf")
        found["real SDF to URDF"] = stages.profile(sdf, "urdf")
    return found


def _machine() -> str:
    """What it was measured on, and what is missing."""
    here = [f"{peer.name} {peer.release()}".strip() for peer in PEERS if peer.present()]
    missing = [f"{peer.name} is not here: it needs {peer.needs}." for peer in PEERS if not peer.present()]
    load = os.getloadavg()[0]
    machine = f"Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores, load {load:.1f}"
    return " ".join([f"{machine}; peers: {', '.join(here) or 'none'}.", *missing])


if __name__ == "__main__":
    sys.exit(main())
