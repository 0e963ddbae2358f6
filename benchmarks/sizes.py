"""From ten links to ten thousand, and well-known robots: times beside the floor, and what peers need to read them."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from benchmarks import inputs
from benchmarks.engines import FLOOR, LOAD, READERS, TO_SDF, TO_URDF, present
from benchmarks.inputs import Robot
from benchmarks.targets import Part, Target, at_most
from benchmarks.turns import Times, cell, in_turns, milliseconds, ratio
from testbed.markdown import subsection, table

SDF_FLOOR = replace(FLOOR, name="floor of the SDF")
LOAD_LIMIT = 6
SDF_LIMITS = {100: 11, 1_000: 11, 10_000: 11}
URDF_LIMIT = 15
_ABOUT = """\
*Floor* is what lxml needs to parse the bytes of the input and to serialize them again. *Load* is `twinform.load`:
parsing, XSD and facts tables, the IR and its verification. A conversion is `twinform.convert` with default options:
load, the passes, writing, and the check of what is written against its XSD. SDF to URDF reads what URDF to SDF wrote,
carriers and all, and has the floor of that SDF. In brackets: times the floor."""
_PEERS = """\
What other readers of URDF need for the same files, in the same turns: none of them writes another format, and they
check less. In brackets: times the floor. What libsdformat, the other converter, needs is in a section of its own."""


@dataclass(frozen=True, slots=True)
class Row:
    """A robot, and the time of each engine."""

    robot: Robot
    times: Times

    def over_floor(self, engine: str) -> float | None:
        """How many times the floor an engine needs."""
        return ratio(self.times[engine], self.times[SDF_FLOOR.name if engine == TO_URDF.name else FLOOR.name])


def measure(robots: Iterable[Robot], rounds: int) -> Part:
    """Let all take turns with each robot."""
    readers = present(READERS)
    engines = [FLOOR, LOAD, TO_SDF, *readers]
    rows: list[Row] = []
    for robot in robots:
        there = in_turns(engines, robot.path, rounds)
        rows.append(Row(robot, {**there, **in_turns([SDF_FLOOR, TO_URDF], inputs.converted(robot, "sdf"), rounds)}))
    for engine in (*engines, SDF_FLOOR, TO_URDF):
        engine.close()
    names = [reader.name for reader in readers]
    return Part(subsection("Sizes", _ABOUT, _own_table(rows), _PEERS, _peer_table(rows, names)), list(targets(rows)))


def _own_table(rows: Iterable[Row]) -> str:
    head = ["robot", "links", "kB", "floor ms", "load ms", "URDF to SDF ms", "us per link", "SDF to URDF ms"]
    return table(head, map(_own_cells, rows))


def _own_cells(row: Row) -> Sequence[object]:
    times, floor = row.times, row.times[FLOOR.name]
    return (
        *(row.robot.name, row.robot.links, row.robot.path.stat().st_size // 1000, cell(floor)),
        *(cell(times[LOAD.name], floor), cell(times[TO_SDF.name], floor)),
        milliseconds(times[TO_SDF.name].seconds / row.robot.links * 1e3),
        cell(times[TO_URDF.name], times[SDF_FLOOR.name]),
    )


def _peer_table(rows: Iterable[Row], names: Sequence[str]) -> str:
    shown = [LOAD.name, TO_SDF.name, *names]
    cells = ([row.robot.name, *(cell(row.times[name], row.times[FLOOR.name]) for name in shown)] for row in rows)
    return table(["robot", "load", "URDF to SDF", *names], cells)


def targets(rows: Sequence[Row]) -> Iterator[Target]:
    """What the figures of this part are held to."""
    made = [row for row in rows if row.robot.shape]
    loads = [row.over_floor(LOAD.name) for row in made]
    yield at_most("load, generated robots of all sizes, in times the floor", LOAD_LIMIT, loads)
    for links, limit in SDF_LIMITS.items():
        found = [row.over_floor(TO_SDF.name) for row in made if row.robot.links == links]
        yield at_most(f"URDF to SDF, {links:,} links, in times the floor", limit, found)
    back = [row.over_floor(TO_URDF.name) for row in made if row.robot.links in SDF_LIMITS]
    yield at_most("SDF to URDF, the same sizes, in times the floor", URDF_LIMIT, back)
