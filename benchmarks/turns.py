"""Engines that take turns with a file, so that what else the machine does slows all of them; medians and ratios."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from statistics import median, quantiles

from benchmarks.engines import Answer, Engine

ENOUGH = 30.0
"""An engine that has had so many seconds for a file gets no further turn."""

Times = Mapping[str, Answer]
"""The answer of each engine, by its name."""


def in_turns(engines: Sequence[Engine], path: Path, rounds: int) -> dict[str, Answer]:
    """The median of the turns of each engine with a file; one that refuses it is asked once."""
    seen: dict[str, list[Answer]] = {engine.name: [] for engine in engines}
    for _ in range(rounds):
        for engine in engines:
            answers = seen[engine.name]
            if not answers or _goes_on(answers):
                answers.append(engine.ask(path))
    return {name: middle(answers) for name, answers in seen.items()}


def _goes_on(answers: Sequence[Answer]) -> bool:
    return not answers[-1].refused and sum(answer.seconds for answer in answers) < ENOUGH


def middle(answers: Sequence[Answer]) -> Answer:
    """The median of the answers; the refusal, where one of them is."""
    refused = next((answer for answer in answers if answer.refused), None)
    return refused or Answer(median(answer.seconds for answer in answers))


def ratio(answer: Answer, base: Answer) -> float | None:
    """How many times longer than another; None where one of both has no time."""
    return None if answer.refused or base.refused or not base.seconds else answer.seconds / base.seconds


def deciles(values: Sequence[float]) -> tuple[float, float, float, float, float]:
    """The least, the tenth, half and ninety percent, and the greatest."""
    if len(values) == 1:
        values = [*values, *values]
    cuts = quantiles(values, n=10, method="inclusive")
    return min(values), cuts[0], median(values), cuts[-1], max(values)


def milliseconds(seconds: float) -> str:
    """A time with three digits."""
    return f"{seconds * 1e3:.3g}" if seconds < 1 else f"{seconds * 1e3:,.0f}"


def cell(answer: Answer, base: Answer | None = None) -> str:
    """A time in ms, and in brackets how many times longer than another it is."""
    if answer.refused:
        return "no answer" if answer.refused.startswith("no answer") else "refuses"
    times = ratio(answer, base) if base is not None else None
    return milliseconds(answer.seconds) + (f" ({times:.1f})" if times is not None else "")
