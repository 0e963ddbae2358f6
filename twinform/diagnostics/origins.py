"""Where the lines of a text were before something was expanded in it."""

from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

from twinform.diagnostics.location import Location


@dataclass(frozen=True, slots=True)
class Origins:
    """For each line of an expanded text that starts an element, the file and line that the element was written on."""

    lines: tuple[int, ...] = ()
    places: tuple[Location, ...] = ()

    @classmethod
    def of(cls, pairs: Iterable[tuple[int, Location]]) -> Self:
        """From lines and places in any order; the first of a line counts."""
        first: dict[int, Location] = {}
        for line, place in pairs:
            first.setdefault(line, place)
        ordered = sorted(first.items())
        return cls(tuple(line for line, _ in ordered), tuple(place for _, place in ordered))

    def place(self, line: int) -> Location | None:
        """Where the element was written that stands on a line or, where none starts there, on the last one before."""
        index = bisect_right(self.lines, line) - 1
        return self.places[index] if index >= 0 else None
