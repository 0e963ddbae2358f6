"""The source line of a finding, with a gutter and the piece that is meant underlined."""

from collections.abc import Iterator
from unicodedata import category, east_asian_width

from twinform.diagnostics.location import Location
from twinform.diagnostics.reporters.printable import printable

_GUTTER = 5
_LONGEST = 120
"""Lines of more characters are cut, so that the piece is in what is left."""
_BEFORE = 40
"""So much of a cut line is shown before the piece."""
_TAB = "    "
_CUT = "..."


def excerpt(where: Location, line: str | None) -> Iterator[tuple[str, str]]:
    """The line of the file, and one with what underlines the piece; the second of each pair is what has a color.

    Of a piece that goes on in other lines only the first one is shown. Nothing is where the line is not known, or the
    finding is about the whole file.
    """
    if line is None or not line.strip() or not (where.column or where.path.strip("/")):
        return
    begin = max(0, where.column - 1)
    end = where.end_column - 1 if where.end_line == where.line else len(line.rstrip())
    end = max(begin + 1, end) if where.end_line else begin + 1
    start, stop = _window(line, begin)
    cut = _CUT if start else ""
    shown = "".join(_shown(each) for each in line[start:stop]).rstrip()
    gutter = max(_GUTTER, len(str(where.line)))
    yield f"{where.line:>{gutter}} | {cut}{shown}{_CUT if stop < len(line) else ''}", ""
    if where.column and begin <= len(line):
        indent = len(cut) + _width(line[start:begin])
        marks = "^" * max(1, _width(line[begin : min(end, stop)]))
        yield f"{'':{gutter}} | {' ' * indent}", marks


def _window(line: str, begin: int) -> tuple[int, int]:
    """The part of a line that is shown."""
    if len(line) <= _LONGEST:
        return 0, len(line)
    start = 0 if begin < _LONGEST - _BEFORE else begin - _BEFORE
    return start, start + _LONGEST


def _shown(character: str) -> str:
    return _TAB if character == "\t" else printable(character)


def _width(text: str) -> int:
    """How many columns of a terminal a text takes, as it is shown."""
    return len(text) if text.isascii() and text.isprintable() else sum(map(_width_of, text))


def _width_of(character: str) -> int:
    if category(character) in {"Mn", "Me"}:
        return 0
    if east_asian_width(character) in {"W", "F"}:
        return 2
    return len(_shown(character))
