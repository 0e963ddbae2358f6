"""Where new elements go in a text, and what goes with those that are taken out: line ends, indentation, comments."""

import re
from dataclasses import dataclass

from twinform.diagnostics import Span
from twinform.text.alignment import BLANKS
from twinform.text.positions import ElementSpan, indentation
from twinform.text.serializing import ElementLayout
from twinform.text.source_text import SourceText

_REST_OF_LINE = re.compile(r"(?:[ \t]*<!--(?:(?!-->)[^\n])*-->)+(?=[ \t]*\r?\n)")
"""Comments behind an element on its line, which are about it."""
_STEP = "  "
"""What new elements are indented by where nothing in the file shows it."""


@dataclass(frozen=True, slots=True)
class TextSurroundings:
    """A text, what ends its lines, and by how much each level is indented more."""

    text: str
    line_end: str
    step: str

    @classmethod
    def of(cls, source: SourceText, root: ElementSpan) -> "TextSurroundings":
        """Find out how a file is laid out: its line ends and its usual indentation."""
        return cls(source.text, source.line_end, _usual_step(source.text, root))

    def before_blanks(self, offset: int) -> int:
        """Where the blanks before an offset begin."""
        while offset and self.text[offset - 1] in BLANKS:
            offset -= 1
        return offset

    def with_line(self, span: Span) -> Span:
        """The span and, where nothing else is on its lines, these lines; else the blanks before it."""
        start = span.start
        while start and self.text[start - 1] in " \t":
            start -= 1
        end = span.end
        while end < len(self.text) and self.text[end] in " \t\r":
            end += 1
        if start and self.text[start - 1] == "\n" and self.text[end : end + 1] == "\n":
            before = start - 1
            return Span(before - (self.text[before - 1 : before] == "\r"), end - (self.text[end - 1] == "\r"))
        return Span(start, span.end)

    def behind(self, end: int) -> int:
        """Behind an element and the comments on its line."""
        found = _REST_OF_LINE.match(self.text, end)
        return found.end() if found else end

    def layout(self, place: ElementSpan) -> ElementLayout:
        """How an element itself is laid out."""
        indent = self._indent(place.whole.start)
        return ElementLayout(indent, self.step) if indent is not None else ElementLayout("", "")

    def layout_inside(self, place: ElementSpan) -> ElementLayout:
        """How new children of an element are laid out: like those that it has."""
        shown = [self._indent(child.whole.start) for child in place.children]
        own = next((indent for indent in shown if indent is not None), None)
        if own is not None:
            return ElementLayout(own, self.step)
        if place.children:
            first = place.children[0].whole.start
            return ElementLayout(self.text[self.before_blanks(first) : first], "")
        return self.layout(place).inner

    def _indent(self, offset: int) -> str | None:
        """The line end and the blanks before what begins its line; None for what does not."""
        blanks = indentation(self.text, offset)
        return None if blanks is None else self.line_end + blanks


def _usual_step(text: str, root: ElementSpan) -> str:
    """By how much the first element that begins a line is indented more than the one around it."""
    for element in root.walk():
        own = indentation(text, element.whole.start)
        for child in element.children:
            inner = indentation(text, child.whole.start)
            if own is not None and inner is not None and inner.startswith(own) and inner != own:
                return inner[len(own) :]
    return _STEP
