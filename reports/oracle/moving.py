"""Twenty robots in each direction, let go in Drake before and after a conversion."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from reports.harness.sample import Sample, in_turn
from reports.oracle.judging import DRAKE, Direction, Outcome, Verdict, cause
from tests.corpus.files import CORPUS
from twinform.testing import oracles
from twinform.testing.oracles.dynamics import moved_alike

DIRECTIONS = (Direction.TO_SDF_11, Direction.TO_URDF)
WANTED = 20
SECONDS = 1.0
_JOINTS = 2
_ALIKE = frozenset({Verdict.FRAMES, Verdict.INERTIAL})
_PATIENCE = 40
"""So many seconds may a simulation take; a robot with light links at strong dampers takes tiny steps."""


@dataclass(frozen=True, slots=True)
class Motion:
    """A conversion, and the verdict of Drake on the motions; no verdict where it cannot simulate the robot."""

    outcome: Outcome
    verdict: oracles.Verdict | None
    cause: str = ""


def motions(sample: Sample, outcomes: Iterable[Outcome]) -> list[Motion]:
    """Robots that move alike, from as many repositories as there are, and those before them that do not.

    Drake cannot simulate every model that it reads, for one a moving link without mass.
    """
    every = list(outcomes)
    return [motion for direction in DIRECTIONS for motion in _first(sample, _candidates(every, direction))]


def _first(sample: Sample, candidates: list[Outcome]) -> list[Motion]:
    found: list[Motion] = []
    while candidates and (missing := WANTED - sum(bool(one.verdict) for one in found)):
        now, candidates = candidates[:missing], candidates[missing:]
        answers = dict(sample.run(_move, now, seconds=_PATIENCE))
        found += [each if isinstance(each := answers[one], Motion) else Motion(one, None, each.cause) for one in now]
    return found


def _candidates(outcomes: list[Outcome], direction: Direction) -> list[Outcome]:
    """One robot of each repository in turn, with joints enough to be interesting."""
    fit = [one for one in outcomes if one.direction is direction and one.verdict in _ALIKE and one.joints >= _JOINTS]
    return in_turn(sorted(fit, key=lambda one: one.name))


def _move(outcome: Outcome) -> Motion:
    assert outcome.output is not None
    try:
        return Motion(outcome, moved_alike(CORPUS / outcome.name, outcome.output, SECONDS))
    except oracles.UnreadableError as error:
        why = cause(error.cause)
        if error.path != outcome.output:
            return Motion(outcome, None, why)
        verdict = oracles.Verdict(DRAKE, None, math.inf, "", f"only the source can be simulated: {why}")
        return Motion(outcome, verdict)
