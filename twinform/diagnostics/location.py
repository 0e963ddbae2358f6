"""Where a thing was written."""

from typing import NamedTuple


class Location(NamedTuple):
    """A place in a source file; every part may be unknown.

    `line` counts from 1, and 0 means unknown. `path` is an XPath that finds the element or attribute again, such as
    `/robot/joint[@name='hip']/limit/@lower`.
    """

    file: str = ""
    line: int = 0
    path: str = ""

    def at(self, step: str) -> "Location":
        """The same line, one step further down the path."""
        return Location(self.file, self.line, f"{self.path}/{step}")


NOWHERE = Location()
