"""Robots with meshes, as packages of ROS 2 that the installed command makes, before programs that read packages."""

import re
import shutil
import subprocess
import sys
import sysconfig
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from reports import packages
from reports.harness.files import OUT
from reports.harness.known import Known
from reports.harness.needs import need
from reports.harness.pages import listing, section, table
from reports.harness.report import UNEXPLAINED, Findings, Report
from reports.harness.sample import Sample
from reports.packages.judges import Packaged
from reports.packages.robots import MISSING, Robot, robots
from reports.ros2_packages.judges import JUDGES

_SECONDS = 300
_SAID = ("--description", "A robot.", "--maintainer", "A. Body", "--email", "a@body.org", "--license", "BSD-3-Clause")
_ABOUT = """\
`twinform package --kind both` is run on robots with meshes of many makers in the packages `example-robot-data` and
`pybullet_data` (extra `robots`), with the transmissions of ROS 1 turned into `<ros2_control>`. Each folder is then
shown to the judges below. A robot that is refused, or with which a judge is not content, has its cause in
`reports/ros2_packages/known.toml`; without one, the command fails."""
KNOWN = Known.beside(__file__)
REFUSALS = Known.beside(packages.__file__)


@dataclass(frozen=True, slots=True)
class Outcome:
    """A robot, why it was refused, which controllers its package has, and what each judge says of it."""

    name: str
    refused: str = ""
    controllers: tuple[str, ...] = ()
    verdicts: tuple[tuple[str, str | None], ...] = ()

    @property
    def why(self) -> str:
        """What the first judge says that is not content; empty where all are."""
        return self.refused or next((f"{judge}: {why}" for judge, why in self.verdicts if why), "")


def measure(sample: Sample) -> Findings:
    """Package every robot, and ask the judges."""
    outcomes = sample.outcomes(
        _judge, sample.of(robots()), lambda robot, why: Outcome(robot.name, why), seconds=_SECONDS
    )
    others = [one for one in outcomes if one.why]
    causes = {one.name: _cause(one) for one in others}
    faults = [f"{one.name}: {one.why}" for one in others if not causes[one.name]]
    green = len(outcomes) - len(others)
    return Findings(list(_page(outcomes, causes)), f"{green} of {len(outcomes)} robots are green", faults)


def _cause(outcome: Outcome) -> str:
    """Why it is right; robots that are refused as a model folder too have their cause there."""
    return KNOWN.why("robots", outcome.name, why=outcome.why) or REFUSALS.why("robots", outcome.name, why=outcome.why)


def _judge(robot: Robot) -> Outcome:
    room = OUT / "ros2_packages" / robot.name
    shutil.rmtree(room, ignore_errors=True)
    folder = room / _package_name(robot)
    done = subprocess.run(_command(robot, str(folder)), capture_output=True, check=False)
    if done.returncode:
        return Outcome(robot.name, refused=_first_error(done.stderr.decode(errors="replace")))
    packaged = Packaged(robot, folder.resolve())
    verdicts = tuple((judge.name, judge.judged(packaged)) for judge in JUDGES if not judge.missing())
    file = folder / "config/controllers.yaml"
    types = re.findall(r"type: (\w+)/", file.read_text(encoding="utf-8")) if file.exists() else []
    return Outcome(robot.name, "", tuple(types), verdicts)


def _package_name(robot: Robot) -> str:
    """A name that ROS takes: that of the file, in its letters."""
    return "_".join(["robot", *re.findall(r"[a-z0-9]+", robot.file.stem.lower())])


def _command(robot: Robot, folder: str) -> list[str]:
    paths = [word for path in robot.paths for word in ("--path", str(path))]
    command = [sys.executable, "-m", "twinform", "package", str(robot.file), "-o", folder, "--kind", "both"]
    return [*command, *paths, *_SAID, "--passes", "ros2-control-from-transmissions", "--no-thumbnail", "--no-config"]


def _first_error(text: str) -> str:
    """The first error of the command, without the places on this machine."""
    found = next((line.partition(": error: ")[2] for line in text.splitlines() if ": error: " in line), text[-300:])
    return found.replace(f"{sysconfig.get_path('purelib')}/", "")


def _page(outcomes: list[Outcome], causes: dict[str, str]) -> Iterable[str]:
    packaged = [one for one in outcomes if not one.refused]
    others = [one for one in outcomes if one.why]
    content = Counter(judge for one in packaged for judge, why in one.verdicts if why == "")
    asked = Counter(judge for one in packaged for judge, why in one.verdicts if why is not None)
    numbers = [("all", len(outcomes)), ("packaged", len(packaged)), ("green", len(outcomes) - len(others))]
    yield table(["robots", "number"], numbers)
    rows = [(each.name, each.about, each.missing() or f"{content[each.name]} of {asked[each.name]}") for each in JUDGES]
    yield section("The judges", table(["judge", "is content where it", "robots"], rows))
    kinds = Counter(kind for one in packaged for kind in one.controllers)
    yield section("Controllers", table(["controller", "number"], sorted(kinds.items())))
    rows = [(one.name, one.why[:160], causes[one.name] or UNEXPLAINED) for one in others]
    yield section("The others", listing(["robot", "what is reported", "cause"], rows))


REPORT = Report(
    "ros2_packages",
    "Packages of ROS 2 of robots with meshes",
    _ABOUT,
    measure,
    (need(lambda: bool(robots()), MISSING),),
    KNOWN,
)
