"""Remedies: the passes that make a model acceptable to its consumers, in the one order in which they run."""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from twinform.ir import Format
from twinform.passes import Pass, parse_pipeline
from twinform.profiles.assessment import Assessment, Judgment


class Remedy(NamedTuple):
    """A pass that rows of profiles name; `physics` is whether it may change masses, joints, limits or collisions."""

    name: str
    physics: bool


# These passes only take away or turn around. What would need a guess (a sensor that Fortress does
# not know, a color of 200, a kinematic loop) stays a finding.
REMEDIES = (
    Remedy("drop-repeats", physics=False),
    Remedy("tidy-materials", physics=False),
    Remedy("tidy-shapes", physics=True),
    Remedy("tag-shapes", physics=False),
    Remedy("tidy-transmissions", physics=False),
    Remedy("replace-continuous", physics=False),
    Remedy("drop-bare-scripts", physics=False),
    Remedy("drop-flat-shapes", physics=True),
    # libsdformat swaps limits that are the wrong way round where it reads URDF, with a warning.
    Remedy("order-limits", physics=True),
    # Before `balance-inertia`, which then sees the shares of inertia that massless links were
    # given.
    Remedy("split-massless", physics=True),
    Remedy("balance-inertia", physics=True),
    Remedy("convert-meshes", physics=False),
)
"""Every pass that a row of a profile may name. Later ones see what earlier ones have made."""
_ORDER = {remedy.name: number for number, remedy in enumerate(REMEDIES)}
_PHYSICS = frozenset(remedy.name for remedy in REMEDIES if remedy.physics)


def remedies(assessments: Iterable[Assessment], to: Format | None = None) -> tuple[Pass, ...]:
    """The passes that help with the judgments, each once, in order, without those for another target format."""
    wanted = dict.fromkeys(text for each in assessments for text in _pipelines_for(each.judgments, to))
    return in_order(step for text in wanted for step in parse_pipeline(text))


def in_order(steps: Iterable[Pass]) -> tuple[Pass, ...]:
    """The passes in the order in which they run, each once."""
    return tuple(sorted(dict.fromkeys(steps), key=lambda step: _ORDER[step.name]))


def changes_physics(step: Pass) -> bool:
    """Whether a pass of a profile may change masses, inertias, joints, limits or collisions."""
    return step.name in _PHYSICS


def _pipelines_for(judgments: Iterable[Judgment], to: Format | None) -> Iterator[str]:
    for judgment in judgments:
        row = judgment.row
        if row.pipeline and (row.to is None or to is None or row.to is to):
            yield row.pipeline
