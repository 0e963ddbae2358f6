"""Robots with meshes, packaged by the installed command, before programs that read packages."""

import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from reports.harness.files import OUT
from reports.harness.known import Known
from reports.harness.needs import need
from reports.harness.pages import listing, section, table
from reports.harness.report import UNEXPLAINED, Findings, Report
from reports.harness.sample import Sample
from reports.packages.judges import JUDGES, Packaged
from reports.packages.robots import MISSING, Robot, robots

_SECONDS = 300
_SAID = ("--description", "A robot.", "--maintainer", "A. Body", "--email", "a@body.org", "--license", "BSD-3-Clause")
_KIND = "gazebo-model"
_VERSIONS = ("1.11", "1.9")
_ABOUT = """\
`twinform package --kind gazebo-model` is run on robots with meshes, which the packages `example-robot-data` and
`pybullet_data` bring (extra `robots`; `reports/packages/robots.py` lists them). Each folder is then shown to the judges
below; the source is not in any of their search paths. A robot that is refused, or with which a judge is not content,
has its cause in `reports/packages/known.toml`; without one, the command fails."""
KNOWN = Known.beside(__file__)


@dataclass(frozen=True, slots=True)
class Outcome:
    """A robot, why it was refused, how many files its package has, and what each judge says of it."""

    name: str
    refused: str = ""
    files: int = 0
    size: int = 0
    verdicts: tuple[tuple[str, str | None], ...] = ()

    @property
    def green(self) -> bool:
        """Whether it was packaged, and all judges are content."""
        return not self.refused and not any(why for _, why in self.verdicts)

    @property
    def why(self) -> str:
        """What the first judge says that is not content."""
        return self.refused or next((f"{judge}: {why}" for judge, why in self.verdicts if why), "")


def measure(sample: Sample) -> Findings:
    """Package every robot, and ask the judges."""
    chosen = sample.of(robots())
    outcomes = sample.outcomes(_judge, chosen, lambda robot, why: Outcome(robot.name, why), seconds=_SECONDS)
    green = sum(one.green for one in outcomes)
    causes = {one.name: KNOWN.why("robots", one.name, why=one.why) for one in outcomes if not one.green}
    faults = [f"{one.name}: {one.why}" for one in outcomes if not one.green and not causes[one.name]]
    return Findings(list(_page(outcomes, causes)), f"{green} of {len(outcomes)} robots are green", faults)


def _judge(robot: Robot) -> Outcome:
    folder = OUT / "packages" / robot.name / robot.file.stem
    shutil.rmtree(folder, ignore_errors=True)
    done = subprocess.run(_command(robot, folder), capture_output=True, check=False)
    if done.returncode:
        return Outcome(robot.name, refused=_first_error(done.stderr.decode(errors="replace")))
    files = [path for path in folder.rglob("*") if path.is_file()]
    packaged = Packaged(robot, folder.resolve())
    verdicts = tuple((judge.name, judge.judged(packaged)) for judge in JUDGES if not judge.missing())
    return Outcome(robot.name, "", len(files), sum(path.stat().st_size for path in files), verdicts)


def _command(robot: Robot, folder: Path) -> list[str]:
    paths = [word for path in robot.paths for word in ("--path", str(path))]
    versions = [word for version in _VERSIONS for word in ("--sdf-version", version)]
    command = [sys.executable, "-m", "twinform", "package", str(robot.file), "-o", str(folder), "--kind", _KIND]
    return [*command, *paths, *versions, *_SAID, "--no-config"]


def _first_error(text: str) -> str:
    """The first error of the command, without the path of the file."""
    return next((line.partition(": error: ")[2] for line in text.splitlines() if ": error: " in line), text[-300:])


def _page(outcomes: list[Outcome], causes: dict[str, str]) -> Iterable[str]:
    green = [one for one in outcomes if one.green]
    packaged = [one for one in outcomes if not one.refused]
    content = Counter(judge for one in packaged for judge, why in one.verdicts if why == "")
    asked = Counter(judge for one in packaged for judge, why in one.verdicts if why is not None)
    yield table(["robots", "number"], [("all", len(outcomes)), ("packaged", len(packaged)), ("green", len(green))])
    rows = [(each.name, each.about, each.missing() or f"{content[each.name]} of {asked[each.name]}") for each in JUDGES]
    yield section("The judges", table(["judge", "is content where it", "robots"], rows))
    sizes = [(one.name, one.files, f"{one.size / 1e6:.1f}") for one in green]
    yield section("Green", table(["robot", "files", "MB"], sizes))
    others = [(one.name, one.why[:160], causes[one.name] or UNEXPLAINED) for one in outcomes if not one.green]
    yield section("The others", listing(["robot", "what is reported", "cause"], others))


REPORT = Report(
    "packages", "Packages of robots with meshes", _ABOUT, measure, (need(lambda: bool(robots()), MISSING),), KNOWN
)
