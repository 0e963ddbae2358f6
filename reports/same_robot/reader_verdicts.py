"""What a reader makes of files that were converted for it: verdicts, and the tables of a section about them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Generic, TypeVar

from reports.harness.known import Known
from reports.harness.section import UNEXPLAINED
from testbed.markdown import cross_table, first, frequent, grouped, listing


class Verdict(StrEnum):
    """What became of a file."""

    SAME = "same robot"
    ABSENT = "same without `<inertial>`"
    TAKEN = "taken"
    DIFFERENT = "different"
    REFUSED = "refused"
    NOT_WRITTEN = "not written"
    SOURCE = "source not taken"


ODD = frozenset({Verdict.REFUSED, Verdict.DIFFERENT, Verdict.NOT_WRITTEN})
"""Verdicts that need a reason."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """A file, in which way it was converted and read, and what became of it; the cause where it is not the same."""

    name: str
    ways: tuple[str, ...]
    verdict: Verdict
    cause: str = ""

    def __str__(self) -> str:
        return ": ".join([self.name, *self.ways, self.verdict, self.cause])


Found = TypeVar("Found", bound=Outcome)


@dataclass(frozen=True)
class Outcomes(Generic[Found]):
    """The outcomes of a section, with known reasons.

    `ways` has the aspects of ways in the file of reasons, each with the head of its column; `odd` are verdicts that
    need a reason.
    """

    found: Sequence[Found]
    known: Known
    ways: Mapping[str, str]
    odd: frozenset[Verdict] = ODD

    def why(self, one: Found) -> str:
        """Why a file is not written, not taken or another robot; empty where nobody knows."""
        ways = dict(zip(self.ways, one.ways, strict=True))
        return self.known.why(one.verdict.name.lower(), file=one.name, cause=one.cause, **ways)

    def counts(self, verdicts: Sequence[Verdict] = tuple(Verdict)) -> str:
        """How many files met each verdict."""
        return cross_table([*self.ways.values()], ((*one.ways, one.verdict) for one in self.found), verdicts)

    def reasons(self, counted: str = "files") -> str:
        """A table of what needs a reason, with it."""
        odd = (one for one in self.found if one.verdict in self.odd)
        rows = grouped(((*one.ways, one.verdict, self.why(one) or UNEXPLAINED), one.name) for one in odd)
        head = [*self.ways.values(), "verdict", "why", counted, "for example"]
        return listing(head, ((*key, len(names), first(names, 2)) for key, names in rows.items()))

    def unexplained(self) -> list[str]:
        """What needs a reason and has none."""
        return [str(one) for one in self.found if one.verdict in self.odd and not self.why(one)]


def complaints(head: Sequence[str], met: Sequence[tuple[tuple[str, ...], str]], most: int | None = None) -> str:
    """A table of causes, the most frequent first; `met` has what stands in the row, and the file."""
    rows = ((*key, *rest) for key, *rest in frequent(met))
    return listing([*head, "for example"], rows, most=most)


def shown(found: list[str], most: int = 3) -> str:
    """The first differences."""
    return "; ".join(found[:most] + ([f"and {len(found) - most} more"] if len(found) > most else []))
