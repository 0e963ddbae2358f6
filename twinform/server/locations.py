"""Locations of the language server protocol: URIs of files, and positions in texts.

Lines count from 0, and columns are in the units of the editor, UTF-16 by default.
"""

import os
from bisect import bisect_right
from itertools import accumulate
from pathlib import Path
from urllib.parse import unquote_to_bytes, urlsplit

from lsprotocol.types import Position, PositionEncodingKind, Range

from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.lazy import lazy_pattern

# The three line ends of the protocol, and no others: pygls splits with `str.splitlines`, which also
# takes form feeds and U+2028, and places every later change wrongly.
_LINE_END = lazy_pattern(r"\r\n|\n|\r")
_WIDTHS = {PositionEncodingKind.Utf8: "utf-8", PositionEncodingKind.Utf16: "utf-16-le"}
_UNITS = {PositionEncodingKind.Utf8: 1, PositionEncodingKind.Utf16: 2}


@dataclass(frozen=True, slots=True)
class Positions:
    """Converts between positions and offsets in a text, which count characters; both are cut to the text."""

    text: str
    starts: tuple[int, ...]
    encoding: PositionEncodingKind

    @classmethod
    def of(cls, text: str, encoding: PositionEncodingKind = PositionEncodingKind.Utf16) -> "Positions":
        """Find the lines of a text."""
        if "\r" in text:
            return cls(text, (0, *(found.end() for found in _LINE_END.finditer(text))), encoding)
        lengths = map(len, text.split("\n"))
        return cls(text, tuple(accumulate(lengths, lambda start, length: start + length + 1, initial=0))[:-1], encoding)

    def offset(self, position: Position) -> int:
        """Return the offset of a position; beyond the end of a line, the end of the line."""
        if position.line >= len(self.starts):
            return len(self.text)
        line = self._line(position.line)
        return self.starts[position.line] + _characters(line, position.character, self.encoding)

    def position(self, offset: int) -> Position:
        """Return the position of an offset."""
        offset = max(0, min(offset, len(self.text)))
        line = self.line(offset)
        return Position(line, _units(self.text[self.starts[line] : offset], self.encoding))

    def line(self, offset: int) -> int:
        """Return the line of an offset."""
        return bisect_right(self.starts, offset) - 1

    def span(self, where: Range) -> Span:
        """Return the span of a range, even if its ends are the wrong way round."""
        ends = self.offset(where.start), self.offset(where.end)
        return Span(min(ends), max(ends))

    def range(self, span: Span) -> Range:
        """Return the range of a span."""
        return Range(self.position(span.start), self.position(span.end))

    def line_span(self, line: int) -> Span:
        """Return a line, counted from 1, without blanks at its ends; the nearest line if there is no such line."""
        index = max(0, min(line - 1, len(self.starts) - 1))
        text = self._line(index)
        start = self.starts[index] + len(text) - len(text.lstrip())
        return Span(start, max(start, self.starts[index] + len(text.rstrip())))

    def _line(self, index: int) -> str:
        """Return a line without its line end."""
        end = self.starts[index + 1] if index + 1 < len(self.starts) else len(self.text)
        return self.text[self.starts[index] : end].rstrip("\r\n")


def _units(text: str, encoding: PositionEncodingKind) -> int:
    if text.isascii() or encoding not in _WIDTHS:
        return len(text)
    return len(text.encode(_WIDTHS[encoding], "surrogatepass")) // _UNITS[encoding]


def _characters(line: str, units: int, encoding: PositionEncodingKind) -> int:
    """Count the whole characters in a number of units."""
    if line.isascii() or encoding not in _WIDTHS:
        return min(units, len(line))
    data = line.encode(_WIDTHS[encoding], "surrogatepass")[: units * _UNITS[encoding]]
    return len(data.decode(_WIDTHS[encoding], "ignore"))


_LONGEST_PATH = 4095
_LONGEST_NAME = 255
"""The limits of Linux in bytes."""
_PROCESSES = Path("/proc")
_UNFIT = lazy_pattern(r"[^\w.+-]+")
_SHOWN = 100


def file_of(uri: str) -> Path | None:
    """Return the file of a URI, whether it exists or not; None if the URI is not that of a file on this machine."""
    try:
        parts = urlsplit(uri)
        data = unquote_to_bytes(parts.path)
    except ValueError:  # brackets without an address in them, or half a character
        return None
    if parts.scheme != "file" or parts.netloc not in {"", "localhost"} or not _is_path(data):
        return None
    path = Path(os.fsdecode(data))
    # A check in another process would see other files there, also through /dev/stdin and /dev/fd.
    return None if path.resolve().is_relative_to(_PROCESSES) else path


def path_of(uri: str) -> Path:
    """Return the file of a URI, or else a name made of the end of the URI, which tells the kind of file."""
    return file_of(uri) or Path(_UNFIT.sub("_", uri[-_SHOWN:].rpartition("/")[2]).lstrip(".") or "untitled")


def uri_of(path: Path) -> str:
    """Return the URI of a file."""
    return path.absolute().as_uri()


def _is_path(data: bytes) -> bool:
    is_short = len(data) <= _LONGEST_PATH and all(len(name) <= _LONGEST_NAME for name in data.split(b"/"))
    return data.startswith(b"/") and b"\0" not in data and is_short
