"""The findings of files, as reporters are given them."""

from collections.abc import Sequence
from typing import NamedTuple, Protocol

from twinform.diagnostics.diagnostic import Diagnostic


class Findings(NamedTuple):
    """The diagnostics of one file, in the order in which they were found."""

    path: str
    diagnostics: tuple[Diagnostic, ...] = ()


class Reporter(Protocol):
    """A pure function from the findings of some files to the text of a report, line ends included."""

    def __call__(self, files: Sequence[Findings], /) -> str:
        """The report."""
        ...
