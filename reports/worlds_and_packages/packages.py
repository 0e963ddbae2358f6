"""Are packaged robots complete, and the same robots, to the programs that read packages?"""

from pathlib import Path

from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.worlds_and_packages.packaging import SECONDS, Outcome, findings, judged, public_robots
from testbed.output_files import OUT
from testbed.packages.judges import JUDGES
from testbed.packages.public_robots import Robot, robots

KNOWN = Known.beside(__file__)
_OPTIONS = ("--kind", "gazebo-model", "--sdf-version", "1.11", "--sdf-version", "1.9")
_ABOUT = """\
`twinform package --kind gazebo-model` is run on robots with meshes, which the packages `example-robot-data` and
`pybullet_data` bring (extra `robots`; `testbed/packages/public_robots.py` lists them). Each folder is then shown to the
judges below; the source is not in any of their search paths. A robot that is refused, or with which a judge is not
content, has its cause in `reports/worlds_and_packages/packages.toml`; without one, the command fails."""


def measure(sample: Sample) -> Findings:
    """Package every robot, and ask the judges."""
    chosen = sample.of(robots())
    outcomes = sample.outcomes(_judge, chosen, lambda robot, why: Outcome(robot.name, why), seconds=SECONDS)
    return findings(outcomes, JUDGES, ("files", "MB"), lambda one: KNOWN.why("robots", one.name, why=one.why))


def _judge(robot: Robot) -> Outcome:
    return judged(robot, OUT / "packages" / robot.name / robot.file.stem, _OPTIONS, JUDGES, _size)


def _size(folder: Path) -> tuple[object, ...]:
    sizes = [path.stat().st_size for path in folder.rglob("*") if path.is_file()]
    return len(sizes), f"{sum(sizes) / 1e6:.1f}"


SECTION = Section("packages", _ABOUT, measure, (public_robots,), KNOWN)
