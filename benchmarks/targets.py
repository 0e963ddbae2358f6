"""What the figures have to be, and whether they are: the table at the head of the page."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from testbed.markdown import table


@dataclass(frozen=True, slots=True)
class Target:
    """What is wanted, what was measured, and whether that is met; None where there is no figure."""

    what: str
    wanted: str
    measured: str
    met: bool | None


@dataclass(frozen=True, slots=True)
class Part:
    """A part of the page: its section, and the targets that its figures are held to."""

    section: str
    targets: Sequence[Target] = ()


def at_most(what: str, limit: float, values: Iterable[float | None], unit: str = "") -> Target:
    """A target that the greatest of the figures has to keep; one that is missing misses it."""
    figures = list(values)
    worst = max(_known(figures), default=None)
    met = worst is not None and None not in figures and worst <= limit
    return _target(what, f"at most {limit:,g}{unit}", figures, worst, unit, met=met)


def at_least(what: str, limit: float, values: Iterable[float | None], unit: str = "") -> Target:
    """A target that the least of the figures has to reach; one that is missing misses it."""
    figures = list(values)
    worst = min(_known(figures), default=None)
    met = worst is not None and None not in figures and worst >= limit
    return _target(what, f"at least {limit:,g}{unit}", figures, worst, unit, met=met)


def _known(figures: Iterable[float | None]) -> list[float]:
    """Those that are there, with the digits that are shown."""
    return [float(f"{value:.4g}") for value in figures if value is not None]


def _target(
    what: str, wanted: str, figures: Sequence[float | None], worst: float | None, unit: str, *, met: bool
) -> Target:
    if not figures:
        return Target(what, wanted, "not measured", None)
    said = [] if worst is None else [f"{worst:,g}{unit}"]
    refused = figures.count(None)
    return Target(what, wanted, ", ".join([*said, *([f"{refused} refused"] if refused else [])]), met)


def target_table(parts: Iterable[Part]) -> str:
    """The table of all targets."""
    words = {True: "yes", False: "**no**", None: ""}
    rows = ((each.what, each.wanted, each.measured, words[each.met]) for part in parts for each in part.targets)
    return table(["what", "target", "measured", "met"], rows)
