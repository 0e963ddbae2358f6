"""How long does a check of a folder take, with one process, with two, and where nothing has changed?"""

import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from testbed.batches.runs import PROGRAM, Cost, run
from testbed.corpus.files import CORPUS
from testbed.markdown import table
from twinform.dataclass import dataclass

_FILES = 500
_LARGEST = 2**20
_LEAST_SPEEDUP, _MOST_KNOWN = 1.8, {"files": 0.5, "xacro": 1.0}
_ABOUT = f"""\
*{_FILES} files* are URDF and SDF files of the corpus, evenly chosen, in one folder under numbers, so that most of their
meshes are missing, as in a clone without them. *xacro* is a repository of all xacro files of the corpus, each
project in a folder of its name; most of them are parts of others. `twinform check` prints what it finds as text: in one
process and in two, both without results of earlier runs, then twice with them, first while they are being kept.
Seconds are those of processors: *own* are the command's, *children* those of the processes that it starts, for xacro
too. The speed-up is what one process has to do over what the busiest processor has to do then."""


@dataclass(frozen=True, slots=True)
class _Costs:
    """What the check of a folder costs."""

    one: Cost
    two: Cost
    kept: Cost
    known: Cost

    @property
    def speedup(self) -> float:
        """Of two processes, on two processors."""
        return _sum(self.one) / max(_sum(self.two) / 2, self.two.own)


def _sum(cost: Cost) -> float:
    return cost.own + cost.children


def measure(sample: Sample) -> Findings:
    """Check both folders."""
    with TemporaryDirectory() as place:
        folders = {"files": Path(place, "files"), "xacro": Path(place, "xacro")}
        _copy_files(folders["files"], sample.every)
        _copy_xacro(folders["xacro"], sample.every)
        found = {name: _costs(folder, Path(place, f"{name}-results")) for name, folder in folders.items()}
    rows = [row for name, costs in found.items() for row in _rows(name, costs)]
    shown = table(["folder", "run", "own, s", "children, s", "both, s", "on the clock, s"], rows)
    return Findings([shown + "\n" + "\n".join(map(_sentence, found.items()))], shown, list(_faults(found)))


def _copy_files(folder: Path, every: int) -> None:
    models = [path for path in sorted(CORPUS.rglob("*")) if path.suffix in {".urdf", ".sdf"} and path.is_file()]
    small = [path for path in models if path.stat().st_size < _LARGEST]
    folder.mkdir()
    for number, path in enumerate(small[:: max(1, len(small) // _FILES)][:_FILES:every]):
        shutil.copyfile(path, folder / f"{number:03}{path.suffix}")


def _copy_xacro(folder: Path, every: int) -> None:
    (folder / ".git").mkdir(parents=True)
    projects = [path for path in sorted(CORPUS.iterdir()) if any(path.rglob("*.xacro"))]
    for project in projects[::every]:
        for path in project.rglob("*"):
            if path.suffix in {".xacro", ".yaml"} and path.is_file():
                target = folder / project.name.partition("+")[2] / path.relative_to(project)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(path, target)


def _costs(folder: Path, results: Path) -> _Costs:
    command = [*PROGRAM, "check", str(folder)]
    anew, keeping = [*command, "--no-cache", "--jobs"], [*command, "--cache-dir", str(results)]
    return _Costs(run([*anew, "1"]), run([*anew, "2"]), run(keeping), run(keeping))


def _rows(name: str, costs: _Costs) -> Iterator[tuple[str, ...]]:
    runs = {"one process": costs.one, "two": costs.two, "results kept": costs.kept, "nothing changed": costs.known}
    for words, cost in runs.items():
        yield name, words, *(f"{each:.2f}" for each in (cost.own, cost.children, _sum(cost), cost.wall))


def _sentence(item: tuple[str, _Costs]) -> str:
    name, costs = item
    return (
        f"*{name}*: {costs.one.summary.partition(':')[0]}; two processes are {costs.speedup:.2f} times one, wanted are "
        f"{_LEAST_SPEEDUP}; where nothing has changed it takes {_sum(costs.known):.2f} s, wanted are at most "
        f"{_MOST_KNOWN[name]}. The load of this machine of {os.cpu_count()} processors was {os.getloadavg()[2]:.1f}.\n"
    )


def _faults(found: dict[str, _Costs]) -> Iterator[str]:
    for name, costs in found.items():
        if costs.speedup < _LEAST_SPEEDUP:
            yield f"{name}: two processes are {costs.speedup:.2f} times one"
        if _sum(costs.known) > _MOST_KNOWN[name]:
            yield f"{name}: a run in which nothing has changed takes {_sum(costs.known):.2f} seconds"


SECTION = Section("folders", _ABOUT, measure)
"""How long does a folder take?"""
