"""MJCF: what it takes to write and to read it, for generated trees, beside the floor and URDF to SDF."""

from collections.abc import Iterable, Sequence

from benchmarks import inputs
from benchmarks.engines import FLOOR, TO_MJCF, TO_SDF, TO_URDF
from benchmarks.inputs import Robot
from benchmarks.targets import Part, at_most
from benchmarks.turns import cell, in_turns, ratio
from testbed.markdown import subsection, table

SIZES = (100, 1_000, 10_000)
TARGET_LINKS, TARGET = 1_000, 12
_HEAD = ("robot", "URDF to SDF", "URDF to MJCF", "SDF to MJCF", "MJCF to SDF", "MJCF to URDF")
_ABOUT = """\
Conversions with default options, in ms; in brackets: times the floor of the file that is read. That is a generated
URDF, or what it became in SDF or MJCF, carriers and all. URDF becomes MJCF by way of SDF."""


def measure(robots: Iterable[Robot], rounds: int) -> Part:
    """Let all conversions take turns with each robot."""
    rows: list[Sequence[str]] = []
    written: list[float | None] = []
    for robot in robots:
        urdf = in_turns([FLOOR, TO_SDF, TO_MJCF], robot.path, rounds)
        sdf = in_turns([FLOOR, TO_MJCF], inputs.converted(robot, "sdf"), rounds)
        mjcf = in_turns([FLOOR, TO_SDF, TO_URDF], inputs.converted(robot, "mjcf"), rounds)
        pairs = ((urdf, TO_SDF), (urdf, TO_MJCF), (sdf, TO_MJCF), (mjcf, TO_SDF), (mjcf, TO_URDF))
        rows.append((robot.name, *(cell(times[engine.name], times[FLOOR.name]) for times, engine in pairs)))
        if robot.links == TARGET_LINKS:
            written.append(ratio(urdf[TO_MJCF.name], urdf[FLOOR.name]))
    for engine in (FLOOR, TO_SDF, TO_URDF, TO_MJCF):
        engine.close()
    target = at_most(f"URDF to MJCF, {TARGET_LINKS:,} links, in times the floor", TARGET, written)
    return Part(subsection("MJCF", _ABOUT, table(_HEAD, rows)), [target])
