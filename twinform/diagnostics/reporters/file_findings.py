"""The findings of files, as reporters are given them."""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

from twinform.diagnostics.diagnostic import Diagnostic


class FileTexts(Protocol):
    """The texts of the files that findings are about, by their names in locations."""

    def line(self, file: str, number: int, /) -> str | None:
        """A line, from 1, without its end; None where it is not known."""
        ...

    def place(self, file: str, offset: int, /) -> tuple[int, int] | None:
        """The line and column, from 1, of an offset in characters; None where it is not known."""
        ...


class _NoTexts:
    """Of texts that are not at hand."""

    def line(self, *_: object) -> None:
        """Nothing is known."""

    def place(self, *_: object) -> None:
        """Nothing is known."""


NO_TEXTS: FileTexts = _NoTexts()


class FileFindings(NamedTuple):
    """The diagnostics of one file, in the order in which they were found, and the texts that they are about."""

    path: str
    diagnostics: tuple[Diagnostic, ...] = ()
    texts: FileTexts = NO_TEXTS


class Reporter(Protocol):
    """A pure function from the findings of some files to the text of a report, line ends included."""

    def __call__(self, files: Sequence[FileFindings], /) -> str:
        """The report."""
        ...


class PlacedEdit(NamedTuple):
    """An edit of a fix: what stands between two places, as lines and columns from 1, becomes `new`."""

    start: tuple[int, int]
    end: tuple[int, int]
    new: str


def placed_edits(diagnostic: Diagnostic, file: str, texts: FileTexts) -> list[PlacedEdit] | None:
    """The edits of the fix of a finding about a file; None where it has none, or their places are not known."""
    if diagnostic.fix is None:
        return None
    name = diagnostic.location.file or file
    found: list[PlacedEdit] = []
    for span, new in diagnostic.fix.edits:
        start, end = texts.place(name, span.start), texts.place(name, span.end)
        if start is None or end is None:
            return None
        found.append(PlacedEdit(start, end, new))
    return found
