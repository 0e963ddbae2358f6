"""What MuJoCo makes of the folder that `package --kind mujoco` writes of a robot with meshes, in a worker process."""

import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from lxml import etree

from reports.same_robot.reader_verdicts import Outcome, Verdict, shown
from testbed.mjcf.compiled import Compiled, UnreadableError, compile_mjcf, compile_urdf
from testbed.mjcf.differences import differences
from testbed.mjcf.mesh_robots import MissingFileError, with_files

_ERROR = ": error: "


@dataclass(frozen=True, slots=True)
class MeshRobot:
    """A URDF below a folder, in which its packages are looked for too."""

    name: str
    path: Path
    folder: Path


@dataclass(frozen=True, slots=True)
class MeshOutcome(Outcome):
    """What became of a robot, how many meshes it has in MuJoCo, and how many seconds it took to write it."""

    meshes: int = 0
    seconds: float = 0.0


def judge(robot: MeshRobot) -> list[MeshOutcome]:
    """Package a robot with the command, and compare what MuJoCo reads of the folder with what it reads of the URDF."""
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        (folder / "meshes").mkdir()
        try:
            text = with_files(robot.path, folder / "meshes")
        except (MissingFileError, etree.XMLSyntaxError, ValueError) as error:
            return [MeshOutcome(robot.name, (), Verdict.SOURCE, str(error))]
        started = time.perf_counter()
        refused = _package(robot, folder / "robot")
        seconds = time.perf_counter() - started
        if refused:
            return [MeshOutcome(robot.name, (), Verdict.NOT_WRITTEN, refused, seconds=seconds)]
        try:
            written = compile_mjcf((folder / "robot/model.xml").read_text(encoding="utf-8"), str(folder / "robot"))
        except UnreadableError as error:
            return [MeshOutcome(robot.name, (), Verdict.REFUSED, str(error), seconds=seconds)]
        verdict, cause = _compare(text, written)
        return [MeshOutcome(robot.name, (), verdict, cause, int(written.model.nmesh), seconds)]


def _package(robot: MeshRobot, made: Path) -> str:
    """Write the folder; return the first error, or nothing."""
    around = [each for each in robot.path.parents if each.is_relative_to(robot.folder)]
    paths = [word for each in around for word in ("--path", str(each))]
    command = [
        sys.executable,
        "-m",
        "twinform",
        "package",
        str(robot.path),
        "-o",
        str(made),
        "--kind",
        "mujoco",
        *paths,
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if not done.returncode:
        return ""
    errors = [line.partition(_ERROR)[2] for line in done.stderr.splitlines() if _ERROR in line]
    return next(iter(errors), done.stderr.strip()[-200:] or "it ends without a word")


def _compare(text: bytes, written: Compiled) -> tuple[Verdict, str]:
    try:
        found = differences(compile_urdf(text, absent_is_nothing=False), written)
    except UnreadableError as error:
        return Verdict.TAKEN, str(error)
    if not found:
        return Verdict.SAME, ""
    try:
        other = differences(compile_urdf(text, absent_is_nothing=True), written)
    except UnreadableError:
        other = found
    return (Verdict.DIFFERENT, shown(other)) if other else (Verdict.ABSENT, shown(found))
