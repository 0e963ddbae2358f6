"""How many small faults do the tests notice? A sample of each room, by mutmut.

The inputs are rooms; all of them if there is none. What was noticed before is not tried again, and a run that is
interrupted writes what is known so far.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import redirect_stdout, suppress
from itertools import chain
from pathlib import Path

from mutmut.__main__ import create_mutants

from reports.harness.sample import Sample
from reports.harness.section import Findings, Section
from reports.mistakes_found.mutants import NOTICED, UNTRIED, Mutant, draw, mutants
from testbed.corpus.files import ROOT
from testbed.markdown import subsection, table

ROOMS = {"ir": 110, "passes": 160, "readers": 60}
"""How many mutants are drawn of each room."""
_SEED = 6
_HEAD = ("room", "mutants", "drawn", "tried", "killed", "timeout", "survived", "no tests", "equivalent", "score")
_ABOUT = f"""\
mutmut changes one operator, number, name, argument, assignment or branch at a time, and runs the tests that reach the
changed function, the nearest first, until one fails or they have taken 15 seconds. Of each room a sample is drawn
with the seed {_SEED}: `ir` and `passes` are the packages, the readers are parsing, loading, the reader and
both ends of each format. The tests are the unit tests of these rooms and the case files, as `[tool.mutmut]` in
`pyproject.toml` has them. Properties, child processes, hostile input, the corpus and the oracles are left out for
speed; they can only raise the score.

Never changed are tables and other data outside functions, fields with their defaults, and what is in a function with a
decorator other than `@staticmethod` and `@classmethod`, such as `@property`, `@cache` and the validators of Pydantic:
mutmut leaves them out. Passed over when drawn is what only changes the wording of a message: a literal with a blank in
it that becomes capitals, small letters or stands between XX; names and texts without a blank stay in. So is what takes
`strict=True` from a `zip` or the type from a `cast`, which only assert what is so.

The score is what was killed or ran into the time limit, of all that were tried and are not equivalent.
Those that few tests reach are tried first: where a run was ended before all that were drawn were tried, the score is of
these, and too low."""


def measure(sample: Sample) -> Findings:
    """Draw mutants, and try those of which nothing is known."""
    rooms = sample.inputs or tuple(ROOMS)
    os.chdir(ROOT)
    with suppress(KeyboardInterrupt):
        _try(rooms, sample)
    drawn = {room: _drawn(room, sample) for room in rooms}
    left = [each for each in chain(*drawn.values()) if each.status not in (*NOTICED, UNTRIED)]
    scores = table(_HEAD, [_row(room, each) for room, each in drawn.items()])
    seen = (f"{each.status}: {each.name} {each.equivalent}\n" + "\n".join(each.diff) for each in left)
    return Findings([scores, *_lists(left)], "\n".join([*seen, scores]))


def _drawn(room: str, sample: Sample) -> list[Mutant]:
    return draw(room, ROOMS[room] // sample.every, sample.seed)


def _try(rooms: Sequence[str], sample: Sample) -> None:
    """Have mutmut try some mutants of each room; what was noticed before is not tried again."""
    processes = sample.jobs or 1
    _refresh()
    with redirect_stdout(sys.stderr):
        create_mutants(processes)
    names = [each.name for room in rooms for each in _drawn(room, sample) if each.status not in NOTICED]
    if names:  # mutmut takes none for all
        command = [Path(sys.executable).with_name("mutmut"), "run", "--max-children", str(processes), *names]
        subprocess.run(command, check=True, stdout=sys.stderr)


def _refresh() -> None:
    """Bring what mutmut copies only once up to date; sources it compares itself."""
    copies = ROOT / "mutants"
    shutil.copytree(ROOT / "twinform", copies / "twinform", ignore=_sources, dirs_exist_ok=True)
    for copy in (copies / "tests").rglob("*.*"):
        if copy.is_file() and copy.suffix != ".pyc" and not (ROOT / copy.relative_to(copies)).exists():
            copy.unlink()


def _sources(_: str, names: list[str]) -> list[str]:
    return [name for name in names if name.endswith(".py") or name == "__pycache__"]


def _row(room: str, drawn: Sequence[Mutant]) -> tuple[object, ...]:
    tried = [each for each in drawn if each.status != UNTRIED]
    unseen = [each for each in tried if each.status not in NOTICED]
    counted = [each.status for each in unseen if not each.equivalent]
    noticed = [sum(each.status == status for each in drawn) for status in NOTICED]
    missed, alike = counted.count("no tests"), len(unseen) - len(counted)
    score = 100 * sum(noticed) / max(1, sum(noticed) + len(counted))
    counts = (len(mutants(room)), len(drawn), len(tried), *noticed, len(counted) - missed, missed, alike)
    return (room, *counts, f"{score:.1f}%")


def _lists(left: Sequence[Mutant]) -> Iterator[str]:
    about = "The program does the same with these, or nothing that anybody could see."
    alike = [(each.function, f"`{each.change}`", each.equivalent) for each in left if each.equivalent]
    yield subsection("Equivalent", about, table(("function", "change", "why"), alike))
    rows = [(each.function, f"`{each.change}`") for each in left if not each.equivalent]
    yield subsection("Not noticed", table(("function", "change"), rows))


SECTION = Section("mutation", _ABOUT, measure, needs=(), seed=_SEED)
