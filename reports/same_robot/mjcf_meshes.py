"""Are robots with meshes the same in MuJoCo: as it reads the URDF, and the folder that `package` makes of it?"""

import re
import statistics
from collections.abc import Sequence
from pathlib import Path

from reports.harness.known import Known
from reports.harness.needs import mujoco
from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.same_robot.mjcf_mesh_verdicts import MeshOutcome, MeshRobot, judge
from reports.same_robot.reader_verdicts import Outcomes, Verdict, complaints
from testbed.installed_robots import installed_folders
from testbed.markdown import cross_table, subsection
from testbed.mjcf.mesh_robots import mesh_robots

KNOWN = Known.beside(__file__)
_ABOUT = """\
Every URDF with meshes that comes with PyBullet, Drake or example-robot-data (`pip install -e '.[robots]'`), or lies in
folders that are given as ARGS, becomes a folder by the installed command, `twinform package --kind mujoco`. What MuJoCo
reads of the folder is compared with what it reads of the URDF itself, as above. For that the URDF gets absolute paths,
and meshes that MuJoCo does not read are converted by trimesh alone; a mesh is the same where it takes up the same space
to 1e-5, since MuJoCo has its points in single precision.

*Taken* are robots that MuJoCo loads from the folder and not from the URDF, and *source not taken* those with meshes
that are nowhere. Of PyBullet's thousand random objects none is in."""
_RANDOM = "random_urdfs"
_NAMES = re.compile(r"'[^']*'|\"[^\"]*\"|[\d.]+(e-?\d+)?")


def measure(sample: Sample) -> Findings:
    """Package, load and compare."""
    found, died = sample.lists(judge, sample.of(_robots(sample.inputs)), seconds=600)
    found.sort(key=lambda one: one.name)
    outcomes = Outcomes(found, KNOWN, {})
    counts = cross_table(["robots"], (("URDF with meshes", one.verdict) for one in found), Verdict)
    taken = [one for one in found if one.verdict in {Verdict.TAKEN, Verdict.SOURCE}]
    causes = [((one.verdict, _NAMES.sub("...", one.cause)[:90]), one.name) for one in taken]
    listed = complaints(["verdict", "complaint", "robots"], causes, most=20)
    parts = [
        subsection("What becomes of a robot with meshes", f"{counts}\n\n{_times(found)}"),
        subsection("Which robots with meshes are not the same, and why", outcomes.reasons("robots")),
        subsection("Complaints of MuJoCo about the sources", listed),
    ]
    return Findings(parts, counts, [*outcomes.unexplained(), *died])


def _robots(folders: Sequence[str]) -> list[MeshRobot]:
    """The robots of the folders, or else of the packages that are installed."""
    named = [(Path(each).name, Path(each).resolve()) for each in folders] or list(installed_folders())
    return [
        MeshRobot(f"{name}/{path.relative_to(folder)}", path, folder)
        for name, folder in named
        for path in mesh_robots(folder)
        if _RANDOM not in path.parts
    ]


def _times(found: Sequence[MeshOutcome]) -> str:
    """How long it takes to write a robot."""
    written = [one for one in found if one.seconds and one.verdict is not Verdict.NOT_WRITTEN]
    if not written:
        return ""
    slowest = max(written, key=lambda one: one.seconds)
    median = statistics.median(one.seconds for one in written)
    return (
        f"It takes {median:.1f} s to write the folder of a robot in the median, and {slowest.seconds:.1f} s at most, "
        f"for the {slowest.meshes} meshes of `{slowest.name}`."
    )


SECTION = Section("mjcf_meshes", _ABOUT, measure, (mujoco,))
