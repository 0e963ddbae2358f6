"""Positions of the language server protocol: lines from 0, and columns in the units that the editor counts."""

import re
from bisect import bisect_right
from dataclasses import dataclass

from lsprotocol.types import Position, PositionEncodingKind, Range

from twinform.diagnostics import Span

# The three line ends of the protocol, and no others: pygls splits with `str.splitlines`, which also
# takes form feeds and U+2028, and places every later change wrongly.
_LINE_END = re.compile(r"\r\n|\n|\r")
_WIDTHS = {PositionEncodingKind.Utf8: "utf-8", PositionEncodingKind.Utf16: "utf-16-le"}
_UNITS = {PositionEncodingKind.Utf8: 1, PositionEncodingKind.Utf16: 2}


@dataclass(frozen=True, slots=True)
class Positions:
    """The positions in one text; offsets count characters. What lies outside of the text is taken for its edge."""

    text: str
    starts: tuple[int, ...]
    encoding: PositionEncodingKind

    @classmethod
    def of(cls, text: str, encoding: PositionEncodingKind = PositionEncodingKind.Utf16) -> "Positions":
        """Prepare the positions of a text for an editor, which counts in UTF-16 unless it says otherwise."""
        return cls(text, (0, *(found.end() for found in _LINE_END.finditer(text))), encoding)

    def offset(self, position: Position) -> int:
        """The offset of a position; beyond the end of a line it is that end."""
        if position.line >= len(self.starts):
            return len(self.text)
        line = self._line(position.line)
        return self.starts[position.line] + _characters(line, position.character, self.encoding)

    def position(self, offset: int) -> Position:
        """The position of an offset."""
        offset = max(0, min(offset, len(self.text)))
        line = bisect_right(self.starts, offset) - 1
        return Position(line, _units(self.text[self.starts[line] : offset], self.encoding))

    def span(self, where: Range) -> Span:
        """The span of a range; one that is upside down is turned."""
        ends = self.offset(where.start), self.offset(where.end)
        return Span(min(ends), max(ends))

    def range(self, span: Span) -> Range:
        """The range of a span."""
        return Range(self.position(span.start), self.position(span.end))

    def line_span(self, line: int) -> Span:
        """A line, counted from 1, without the blanks around what is in it; the nearest one where there is none."""
        index = max(0, min(line - 1, len(self.starts) - 1))
        text = self._line(index)
        start = self.starts[index] + len(text) - len(text.lstrip())
        return Span(start, max(start, self.starts[index] + len(text.rstrip())))

    def _line(self, index: int) -> str:
        """The text of a line without its end."""
        end = self.starts[index + 1] if index + 1 < len(self.starts) else len(self.text)
        return self.text[self.starts[index] : end].rstrip("\r\n")


def _units(text: str, encoding: PositionEncodingKind) -> int:
    if text.isascii() or encoding not in _WIDTHS:
        return len(text)
    return len(text.encode(_WIDTHS[encoding], "surrogatepass")) // _UNITS[encoding]


def _characters(line: str, units: int, encoding: PositionEncodingKind) -> int:
    """How many characters so many units are; in the middle of a character, those before it."""
    if line.isascii() or encoding not in _WIDTHS:
        return min(units, len(line))
    data = line.encode(_WIDTHS[encoding], "surrogatepass")[: units * _UNITS[encoding]]
    return len(data.decode(_WIDTHS[encoding], "ignore"))
