"""URDF to SDF by us and by libsdformat 12, on the corpus and on trees and chains."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from benchmarks.engines import LIBSDFORMAT, LIBSDFORMAT_ONCE, TO_SDF
from benchmarks.inputs import Robot
from benchmarks.targets import Part, Target, at_least
from benchmarks.turns import Times, cell, deciles, in_turns, milliseconds, ratio
from testbed.markdown import listing, subsection, table

LEAST, MIDDLE = 3.5, 12
_ABOUT = """\
URDF to SDF, each in a process that goes from file to file: `twinform.convert` with default options, which validates
input and output, and libsdformat 12 as `gz sdf --print` and `sdf::Root::Load` begin: its own description of SDF is
read, then the file, and what came of it is written. *Description read before*: the same without the first step, for a
program that keeps the description from file to file. The ratio is how many times faster we are."""
_NEWER = """\
libsdformat 17 was measured on 2026-11-22, on another day of this machine, and is not measured here: 37 ms and 0.27 ms
for each link of a tree; a chain of 1,000 links took 1,360 ms, and grows by the square."""
_BASE_17, _LINK_17, _CHAIN_17 = 0.037, 0.00027, {1_000: 1.360}
_SHOWN = 10


@dataclass(frozen=True, slots=True)
class Row:
    """A file that both convert, or one of both does not."""

    robot: Robot
    times: Times

    def faster(self, engine: str = LIBSDFORMAT.name) -> float | None:
        """How many times faster we are; None where one of both refuses the file."""
        return ratio(self.times[engine], self.times[TO_SDF.name])


def measure(real: Iterable[Robot], others: Iterable[Robot], made: Iterable[Robot], rounds: int) -> Part:
    """Let both take turns with each file: those of the corpus, others that were given, generated ones."""
    title = "Beside libsdformat"
    if not LIBSDFORMAT.present():
        return Part(subsection(title, "libsdformat 12 is not here.", _NEWER), list(targets([])))
    engines = [TO_SDF, LIBSDFORMAT, LIBSDFORMAT_ONCE]
    corpus, given, generated = (
        [Row(each, in_turns(engines, each.path, rounds)) for each in group] for group in (real, others, made)
    )
    for engine in engines:
        engine.close()
    groups = {"corpus": corpus, "other robots": given, "generated": generated}
    parts = [_ABOUT, _summary(groups), _verdicts(corpus), _slowest(corpus), _NEWER, _each_robot([*given, *generated])]
    return Part(subsection(title, *parts), list(targets([*corpus, *given, *generated])))


def compared(rows: Iterable[Row], engine: str = LIBSDFORMAT.name) -> list[tuple[float, Row]]:
    """The rows in which both have a time, with how many times faster we are: the least first."""
    found = [(faster, row) for row in rows if (faster := row.faster(engine)) is not None]
    return sorted(found, key=lambda pair: pair[0])


def _summary(groups: Mapping[str, Sequence[Row]]) -> str:
    head = ["files", "libsdformat", "both", f"{LEAST:g} times and more", "least", "10 %", "median", "90 %", "most"]
    rows = [
        _summary_row(name, said, compared(rows, engine))
        for name, rows in groups.items()
        for engine, said in ((LIBSDFORMAT.name, "as called"), (LIBSDFORMAT_ONCE.name, "description read before"))
    ]
    return table(head, [row for row in rows if row])


def _summary_row(name: str, engine: str, pairs: Sequence[tuple[float, Row]]) -> Sequence[object]:
    if not pairs:
        return ()
    values = [faster for faster, _ in pairs]
    many = sum(value >= LEAST for value in values)
    return name, engine, len(values), many, *(f"{value:.2f}" for value in deciles(values))


def _verdicts(rows: Sequence[Row]) -> str:
    """Who takes how many of the corpus."""
    ours = [row for row in rows if row.times[TO_SDF.name].refused and not row.times[LIBSDFORMAT.name].refused]
    theirs = sum(1 for row in rows if row.times[LIBSDFORMAT.name].refused)
    said = f"Of {len(rows)} URDF files of the corpus libsdformat 12 does not take {theirs}"
    return f"{said}; of the others we refuse {len(ours)}{': ' if ours else ''}{', '.join(_name(row) for row in ours)}."


def _slowest(rows: Sequence[Row]) -> str:
    shown = ((_name(row), *_cells(row), f"{faster:.2f}") for faster, row in compared(rows)[:_SHOWN])
    head = ["least ratios of the corpus", "ours ms", "libsdformat ms", "description read before, ms", "ratio"]
    return listing(head, shown)


def _each_robot(rows: Sequence[Row]) -> str:
    head = ["robot", "ours ms", "libsdformat 12 ms", "description read before, ms", "ratio", "libsdformat 17 ms"]
    return table(head, [(row.robot.name, *_cells(row), _times(row.faster()), _newer(row.robot)) for row in rows])


def _cells(row: Row) -> Sequence[str]:
    return [cell(row.times[engine.name]) for engine in (TO_SDF, LIBSDFORMAT, LIBSDFORMAT_ONCE)]


def _times(value: float | None) -> str:
    return "" if value is None else f"{value:.2f}"


def _newer(robot: Robot) -> str:
    """What libsdformat 17 needed, where that is known."""
    seconds = _BASE_17 + _LINK_17 * robot.links if robot.shape == "tree" else _CHAIN_17.get(robot.links)
    return "" if seconds is None else milliseconds(seconds)


def _name(row: Row) -> str:
    return f"`{row.robot.name}`"


def targets(rows: Sequence[Row]) -> Iterator[Target]:
    """What the figures of this part are held to."""
    values = [faster for faster, _ in compared(rows)]
    yield at_least("URDF to SDF, times faster than libsdformat 12, every file", LEAST, values)
    yield at_least("the same, median", MIDDLE, [deciles(values)[2]] if values else [])
