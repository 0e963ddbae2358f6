"""A section of a page: what it measures, what it needs, and its text."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from reports.harness.known import Known
from reports.harness.needs import corpus
from reports.harness.sample import Sample
from testbed.markdown import paragraphs

UNEXPLAINED = "**unexplained**"


@dataclass(frozen=True, slots=True)
class Findings:
    """What was measured: parts of the section, a few lines to print, and what is wrong and has no known cause."""

    parts: Sequence[str]
    summary: str
    faults: Sequence[str] = ()


@dataclass(frozen=True, slots=True)
class Section:
    """A measurement; `needs` explain why it cannot be made here, if so; all causes in `known` have to be met."""

    name: str
    about: str
    measure: Callable[[Sample], Findings]
    needs: tuple[Callable[[], str], ...] = (corpus,)
    known: Known | None = None
    seed: int = 1

    @property
    def missing(self) -> str:
        """What is needed and is not here; empty where all is."""
        return next(filter(None, (need() for need in self.needs)), "")

    def text(self, title: str, found: Findings, every: int = 1) -> str:
        """The section in Markdown, measured on one of `every` models."""
        share = f' ARGS="--every {every}"`, from one of {every} models.' if every != 1 else "`."
        return paragraphs(f"## {title}", f"Made by `make report NAME={self.name}{share}", self.about, *found.parts)
