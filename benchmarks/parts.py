"""The parts of what is measured about speed, and how much of each."""

import os
import platform
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks import commands, comments, converters, inputs, mjcf, real_files, scale, sizes, stages
from benchmarks.engines import PEERS
from benchmarks.inputs import Robot, generated
from benchmarks.targets import Part, at_most
from testbed.corpus.files import ROOT, Kind
from testbed.markdown import subsection, table

PROFILED = 1_000


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


def measured_parts(extent: Extent, before: Path | None, others: Path | None) -> Iterator[Part]:
    """Each part of the page, once it is measured; an older checkout and a folder of other robots may be given."""
    trees, chains = ([generated(shape, links) for links in some] for shape, some in _shapes(extent))
    yield _announce(sizes.measure([*trees, *chains, *inputs.known()], extent.rounds))
    yield _announce(mjcf.measure([robot for robot in trees if robot.links in mjcf.SIZES], extent.rounds))
    corpus = [Robot(file.name, file.path, 0) for file in inputs.corpus(extent.every, Kind.URDF)]
    made = [generated(shape, links) for shape in ("tree", "chain") for links in extent.converted]
    yield _announce(converters.measure(corpus, inputs.robots_in(others), made, extent.corpus_rounds))
    yield _announce(comments.measure([robot.path for robot in corpus], extent.corpus_rounds))
    yield _announce(real_files.measure(before, extent.every, extent.corpus_rounds))
    yield _announce(_commands(extent.runs))
    yield _announce(scale.measure(extent.scale))
    yield _announce(Part(stages.page(_profiles(extent.every))))


def _shapes(extent: Extent) -> Sequence[tuple[str, Sequence[int]]]:
    return ("tree", extent.trees), ("chain", extent.chains)


def _announce(part: Part) -> Part:
    print(part.section.partition("\n")[0], "is measured", file=sys.stderr, flush=True)
    return part


def _commands(runs: int) -> Part:
    with tempfile.TemporaryDirectory() as folder:
        found = commands.measured(Path(folder), [ROOT], runs)
    milliseconds = {command.name: ms for command, ms in found.items()}
    bare = milliseconds[commands.BARE]
    targets = [
        at_most(f"{name}, over `{base}`", limit, [milliseconds[name] - milliseconds[base]], " ms")
        for name, base, limit in commands.LIMITS
    ]
    about = f"From start to exit, the median of {runs} runs; the robot is a tree."
    rows = ((name, f"{ms:.0f}", f"{ms - bare:.0f}") for name, ms in milliseconds.items())
    return Part(
        subsection("Whole commands", about, table(["command", "CPU ms", f"over `{commands.BARE}`"], rows)), targets
    )


def _profiles(every: int) -> dict[str, Mapping[str, float]]:
    """Where the time goes in a generated tree and in all real files."""
    tree = generated("tree", PROFILED)
    urdf, sdf = ([file.path for file in inputs.corpus(every, kind)] for kind in (Kind.URDF, Kind.SDF))
    found = {
        f"{tree.name} to SDF": stages.profile([tree.path], "sdf"),
        f"{tree.name} to URDF": stages.profile([inputs.converted(tree, "sdf")], "urdf"),
        f"{tree.name} to MJCF": stages.profile([tree.path], "mjcf"),
        f"{tree.name}, MJCF to SDF": stages.profile([inputs.converted(tree, "mjcf")], "sdf"),
    }
    if urdf and sdf:
        found["real URDF to SDF"] = stages.profile(urdf, "sdf")
        found["real SDF to URDF"] = stages.profile(sdf, "urdf")
    return found


def machine() -> str:
    """What it was measured on, and what is missing."""
    here = [f"{peer.name} {peer.release()}".strip() for peer in PEERS if peer.present()]
    missing = [f"{peer.name} is not here: it needs {peer.needs}." for peer in PEERS if not peer.present()]
    load = os.getloadavg()[0]
    machine = f"Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} cores, load {load:.1f}"
    return " ".join([f"{machine}; peers: {', '.join(here) or 'none'}.", *missing])
