"""Robots with meshes, packaged by the installed command, before the programs that read such packages."""

import shutil
import subprocess
import sys
import sysconfig
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from reports.harness.needs import need
from reports.harness.section import UNEXPLAINED, Findings
from testbed.markdown import listing, subsection, table
from testbed.packages.judges import Judge, Packaged
from testbed.packages.public_robots import MISSING, Robot, robots

public_robots = need(lambda: bool(robots()), MISSING)
SECONDS = 300
_SAID = ("--description", "A robot.", "--maintainer", "A. Body", "--email", "a@body.org", "--license", "BSD-3-Clause")


@dataclass(frozen=True, slots=True)
class Outcome:
    """A robot, why it was refused, its package in a few cells of a table, and what each judge says of it."""

    name: str
    refused: str = ""
    cells: tuple[object, ...] = ()
    verdicts: tuple[tuple[str, str | None], ...] = ()

    @property
    def why(self) -> str:
        """What the first judge says that is not content; empty where all are."""
        return self.refused or next((f"{judge}: {why}" for judge, why in self.verdicts if why), "")


def judged(
    robot: Robot,
    folder: Path,
    options: Sequence[str],
    judges: Sequence[Judge],
    cells: Callable[[Path], tuple[object, ...]],
) -> Outcome:
    """Package a robot into a folder, whose parent is emptied, and ask the judges."""
    shutil.rmtree(folder.parent, ignore_errors=True)
    paths = [word for path in robot.paths for word in ("--path", str(path))]
    command = [
        sys.executable,
        "-m",
        "twinform",
        "package",
        str(robot.file),
        "-o",
        str(folder),
        *options,
        *paths,
        *_SAID,
    ]
    done = subprocess.run([*command, "--no-config"], capture_output=True, check=False)
    if done.returncode:
        return Outcome(robot.name, refused=_first_error(done.stderr.decode(errors="replace")))
    packaged = Packaged(robot, folder.resolve())
    verdicts = tuple((judge.name, judge.judged(packaged)) for judge in judges if not judge.missing())
    return Outcome(robot.name, "", cells(folder), verdicts)


def _first_error(text: str) -> str:
    """The first error of the command, without the path of the file and other places on this machine."""
    found = next((line.partition(": error: ")[2] for line in text.splitlines() if ": error: " in line), text[-300:])
    return found.replace(f"{sysconfig.get_path('purelib')}/", "")


def findings(
    outcomes: Sequence[Outcome], judges: Sequence[Judge], head: Sequence[str], why: Callable[[Outcome], str]
) -> Findings:
    """The parts of the section; `head` names the cells of a package, `why` gives a known cause."""
    others = {one: why(one) for one in outcomes if one.why}
    faults = [f"{one.name}: {one.why}" for one, cause in others.items() if not cause]
    green = [one for one in outcomes if not one.why]
    summary = f"{len(green)} of {len(outcomes)} robots are green"
    rows = [(one.name, one.why[:160], cause or UNEXPLAINED) for one, cause in others.items()]
    parts = [
        *_counts(outcomes, judges),
        subsection("Green", table(["robot", *head], [(one.name, *one.cells) for one in green])),
        subsection("The others", listing(["robot", "what is reported", "cause"], rows)),
    ]
    return Findings(parts, summary, faults)


def _counts(outcomes: Sequence[Outcome], judges: Sequence[Judge]) -> Iterator[str]:
    packaged = [one for one in outcomes if not one.refused]
    content = Counter(judge for one in packaged for judge, why in one.verdicts if why == "")
    asked = Counter(judge for one in packaged for judge, why in one.verdicts if why is not None)
    green = sum(not one.why for one in outcomes)
    yield table(["robots", "number"], [("all", len(outcomes)), ("packaged", len(packaged)), ("green", green)])
    rows = [(each.name, each.about, each.missing() or f"{content[each.name]} of {asked[each.name]}") for each in judges]
    yield subsection("The judges", table(["judge", "is content where it", "robots"], rows))
