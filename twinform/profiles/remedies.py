"""Remedies: the passes that make a model acceptable to its consumers, in the one order in which they run."""

from collections.abc import Iterable
from typing import NamedTuple

from twinform.passes import Pass, Pipeline, parse_pipeline
from twinform.profiles.assessment import Assessment


class Remedy(NamedTuple):
    """A pass that rows name, and whether it changes the physics: masses, inertias, joints or limits."""

    name: str
    physics: bool


REMEDIES = (
    Remedy("drop-repeats", physics=False),
    Remedy("tidy-materials", physics=False),
    Remedy("tidy-shapes", physics=False),
    Remedy("tidy-transmissions", physics=False),
    Remedy("replace-continuous", physics=False),
    Remedy("fill-limits", physics=True),
    Remedy("split-massless", physics=True),
    Remedy("balance-inertia", physics=True),
)
"""Every pass that a row of a profile may name. Later ones see what earlier ones have made."""
_ORDER = {remedy.name: number for number, remedy in enumerate(REMEDIES)}
_PHYSICS = frozenset(remedy.name for remedy in REMEDIES if remedy.physics)


def remedies(assessments: Iterable[Assessment]) -> Pipeline:
    """The passes that help with what was found, each once, in order."""
    wanted = dict.fromkeys(
        judgment.row.pipeline for each in assessments for judgment in each.judgments if judgment.row.pipeline
    )
    steps = {str(Pipeline((step,))): step for text in wanted for step in parse_pipeline(text)}
    return Pipeline(tuple(sorted(steps.values(), key=lambda step: _ORDER[step.name])))


def changes_physics(step: Pass) -> bool:
    """Whether a pass of a profile changes masses, inertias, joints or limits."""
    return step.name in _PHYSICS
