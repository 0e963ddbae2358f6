"""Pieces of a text, and what they are replaced by."""

from typing import NamedTuple


class Span(NamedTuple):
    """A piece of text, from `start` up to but not including `end`; offsets count characters from 0."""

    start: int
    end: int

    def of(self, text: str) -> str:
        """The piece itself."""
        return text[self.start : self.end]


class TextEdit(NamedTuple):
    """The piece of the text at `span` becomes `new`; an empty span is where it is inserted."""

    span: Span
    new: str
