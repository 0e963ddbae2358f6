"""Robots that Drake lets go, before and after something was done to them."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from reports.harness.sample import Sample
from testbed.markdown import table
from twinform.testing import oracles
from twinform.testing.oracles.drake import TOLERANCE, moved_alike

WANTED = 20
"""So many robots have to move alike."""
_SECONDS = 1.0
_PATIENCE = 40
"""So many seconds may a simulation take; a robot with light links at strong dampers takes tiny steps."""
ABOUT = f"""\
Drake lets robots go for {_SECONDS:g} s from one state, which is not at rest, under gravity and without motors or
contacts, by an integrator with an accuracy of 1e-10. Positions and velocities of joints and free links, at ten
moments, are the same where they differ by no more than {TOLERANCE:g} (of the largest number of the kind, where that is
more than one). Robots are taken from one repository after another until {WANTED} of each kind move alike."""
Job = TypeVar("Job")


@dataclass(frozen=True, slots=True)
class Motion:
    """A robot, what was done to it, and Drake's verdict on its motions: none where it cannot simulate the source."""

    done: str
    name: str
    count: int
    verdict: oracles.Verdict | None
    cause: str = ""

    @property
    def is_fault(self) -> bool:
        """Whether it moves otherwise."""
        return self.verdict is not None and not self.verdict


def motion(done: str, name: str, count: int, source: Path, result: Path) -> Motion:
    """The motions of a source and its result; `count` is of joints, or of whatever makes a robot interesting."""
    try:
        verdict = moved_alike(source, result, _SECONDS)
    except oracles.EngineUnreadableError as error:
        if error.path != result:
            return Motion(done, name, count, None, error.cause.partition("\n")[0])
        verdict = oracles.Verdict("drake", None, math.inf, "", f"only the source can be simulated: {error.cause}")
    return Motion(done, name, count, verdict, verdict.cause)


def motions(sample: Sample, move: Callable[[Job], Motion | None], jobs: Sequence[Job]) -> list[Motion]:
    """The motions of the first robots, until enough of them move alike; None is passed over."""
    found, left = list[Motion](), list(jobs)
    while left and sum(bool(one.verdict) for one in found) < WANTED:
        now, left = left[:WANTED], left[WANTED:]
        answers = dict(sample.run(move, now, seconds=_PATIENCE))
        found += [one for job in now if isinstance(one := answers[job], Motion)]
    return found


def motion_table(found: Iterable[Motion], counted: str, why: Callable[[Motion], str] = lambda _: "") -> str:
    """A row for each robot; `counted` is what their counts are of, `why` gives a known cause."""
    rows = [(one.done, one.name, one.count, *_moved(one, why(one))) for one in found]
    return table(["what was done", "file", counted, "verdict", "largest difference", "of"], rows)


def _moved(one: Motion, why: str) -> tuple[str, str, str]:
    if one.verdict is None:
        return "Drake cannot simulate the source", "", one.cause
    verdict = "the same" if one.verdict else "different"
    return verdict, f"{one.verdict.deviation:.1g}", one.verdict.of if one.verdict else why or one.cause
