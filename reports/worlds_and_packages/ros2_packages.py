"""Do packages of ROS 2 build, launch and publish the robot, to catkin, CMake, launch files, urdfdom and ROS itself?"""

import re
from collections import Counter
from pathlib import Path

from reports.harness.known import Known
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.worlds_and_packages.packages import KNOWN as REFUSALS
from reports.worlds_and_packages.packaging import SECONDS, Outcome, findings, judged, public_robots
from testbed.output_files import OUT
from testbed.packages.public_robots import Robot, robots
from testbed.packages.ros2_judges import JUDGES

KNOWN = Known.beside(__file__)
_OPTIONS = ("--kind", "both", "--passes", "ros2-control-from-transmissions", "--no-thumbnail")
_ABOUT = """\
`twinform package --kind both` is run on robots with meshes of many makers in the packages `example-robot-data` and
`pybullet_data` (extra `robots`), with the transmissions of ROS 1 turned into `<ros2_control>`. Each folder is then
shown to the judges below. A robot that is refused, or with which a judge is not content, has its cause in
`reports/worlds_and_packages/ros2_packages.toml`; without one, the command fails."""


def measure(sample: Sample) -> Findings:
    """Package every robot, and ask the judges."""
    chosen = sample.of(robots())
    outcomes = sample.outcomes(_judge, chosen, lambda robot, why: Outcome(robot.name, why), seconds=SECONDS)
    return findings(outcomes, JUDGES, ("controllers",), _cause)


def _cause(outcome: Outcome) -> str:
    """Why it is right; robots that are refused as a model folder too have their cause there."""
    return KNOWN.why("robots", outcome.name, why=outcome.why) or REFUSALS.why("robots", outcome.name, why=outcome.why)


def _judge(robot: Robot) -> Outcome:
    return judged(robot, OUT / "ros2_packages" / robot.name / _package_name(robot), _OPTIONS, JUDGES, _controllers)


def _package_name(robot: Robot) -> str:
    """A name that ROS takes: that of the file, in its letters."""
    return "_".join(["robot", *re.findall(r"[a-z0-9]+", robot.file.stem.lower())])


def _controllers(folder: Path) -> tuple[object, ...]:
    """How many controllers of each kind the package configures."""
    file = folder / "config/controllers.yaml"
    types = Counter(re.findall(r"type: (\w+)/", file.read_text(encoding="utf-8")) if file.exists() else ())
    return (", ".join(f"{count} {kind}" for kind, count in sorted(types.items())),)


SECTION = Section("ros2_packages", _ABOUT, measure, (public_robots,), KNOWN)
