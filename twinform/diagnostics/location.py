"""Source locations: file, line and XML path, also through the expansion of xacro and includes."""

from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple, Self


class Location(NamedTuple):
    """A place in a source file; every part may be unknown.

    `line` counts from 1, and 0 means unknown. `path` is an XPath that finds the element or attribute again, such as
    `/robot/joint[@name='hip']/limit/@lower`. The columns, and the end of the piece of text, which does not belong to it
    any more, are known only where somebody has asked for them (`compiler/input/finding_spans.py`).
    """

    file: str = ""
    line: int = 0
    path: str = ""
    column: int = 0
    end_line: int = 0
    end_column: int = 0

    def at(self, step: str) -> "Location":
        """Return the location one step further down the path, on the same line."""
        return Location(self.file, self.line, f"{self.path}/{step}")


NOWHERE = Location()


class Source(NamedTuple):
    """Where a part of a document was read, in a form that is cheap to keep: the path is made when it is asked for.

    `above` is the source of the node around it, `step` the element names from there, and `key` the name of the last
    one or its place among its like, where it needs one to be found.
    """

    file: str
    line: int
    above: "Source | None"
    step: str
    key: str | int | None = None

    @property
    def path(self) -> str:
        """An XPath from the root of the file."""
        steps: list[str] = []
        here: Source | None = self
        while here is not None:
            steps.append(here.last_step)
            here = here.above
        return "/" + "/".join(reversed(steps))

    @property
    def last_step(self) -> str:
        """The step from the node around it to this part."""
        if self.key is None:
            return self.step
        return f"{self.step}[{self.key}]" if isinstance(self.key, int) else f"{self.step}[@name='{self.key}']"

    @property
    def location(self) -> Location:
        """The `Location` of this place."""
        return Location(self.file, self.line, self.path)


@dataclass(frozen=True, slots=True)
class LineOrigins:
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
