"""The report for people: each finding with the line of the file that it is about, and the piece underlined."""

from collections.abc import Callable, Iterator, Sequence
from unicodedata import category, east_asian_width

from twinform.diagnostics.diagnostic import Diagnostic, Location, Severity
from twinform.diagnostics.reporters.file_findings import FileFindings, Group, grouped, printable

Paint = Callable[[str, Severity], str]
"""Gives a word the color of a severity."""
_SHOWN = 3
"""So many places of one cause are named."""


def _unpainted(word: str, _: Severity) -> str:
    return word


def text(files: Sequence[FileFindings], paint: Paint = _unpainted, *, every: bool = False) -> str:
    """`file:line:column: severity: headline [rule]`, then XML path, source line, related places, help and fix.

    Findings of one cause are one, with a count, unless `every` one is wanted. Empty without findings.
    """
    return "".join(
        f"{line}\n"
        for file in files
        for group in grouped(file.diagnostics, every=every)
        for line in _lines_of_group(group, file, paint)
    )


def concise(files: Sequence[FileFindings], paint: Paint = _unpainted) -> str:
    """One line for each finding: `file:line:column: severity: headline [rule]`."""
    return "".join(f"{_headline(each, file.path, paint)}\n" for file in files for each in file.diagnostics)


def _lines_of_group(group: Group, file: FileFindings, paint: Paint) -> Iterator[str]:
    diagnostic, others = group
    where, severity = diagnostic.location, diagnostic.severity
    count = f", {len(others) + 1} x" if others else ""
    yield f"{_headline(diagnostic, file.path, paint)}{count}"
    if where.path:
        yield f"    at {printable(where.path)}"
    for line, marks in excerpt(where, file.texts.line(where.file or file.path, where.line)):
        yield f"{line}{paint(marks, severity) if marks else ''}"
    if others:
        yield f"    also at {_also(others)}"
    for other in diagnostic.related:
        yield f"    see {_place(other, file.path)}{f': {printable(other.path)}' if other.path else ''}"
    for number, line in enumerate((diagnostic.help or "").splitlines()):
        yield f"    {'      ' if number else 'help: '}{printable(line)}"
    if diagnostic.fix is not None:
        yield f"    fix ({diagnostic.fix.safety}): {printable(diagnostic.fix.title)}"


def _headline(diagnostic: Diagnostic, file: str, paint: Paint) -> str:
    severity, message = diagnostic.severity, printable(diagnostic.message.strip())
    return f"{_place(diagnostic.location, file)}: {paint(str(severity), severity)}: {message} [{diagnostic.rule.name}]"


def _also(others: tuple[Diagnostic, ...]) -> str:
    places = ", ".join(_line_and_column(each.location) for each in others[:_SHOWN])
    more = len(others) - _SHOWN
    return f"{places} and {more} more; --all shows each" if more > 0 else places


def _place(location: Location, file: str) -> str:
    name = printable(location.file or file)
    return f"{name}:{_line_and_column(location)}" if location.line else name


def _line_and_column(location: Location) -> str:
    return f"{location.line}:{location.column}" if location.column else f"{location.line}"


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
    if not line or line.isspace() or not (where.column or where.path.strip("/")):
        return
    begin = max(0, where.column - 1)
    start, stop = _window(line, begin)
    cut = _CUT if start else ""
    shown = "".join(_shown(each) for each in line[start:stop]).rstrip()
    gutter = max(_GUTTER, len(str(where.line)))
    yield f"{where.line:>{gutter}} | {cut}{shown}{_CUT if stop < len(line) else ''}", ""
    if where.column and begin <= len(line):
        indent = len(cut) + _width(line[start:begin])
        end = where.end_column - 1 if where.end_line <= where.line else start + len(line[start:stop].rstrip())
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
    """Return how many columns of a terminal a text takes."""
    return len(text) if text.isascii() and text.isprintable() else sum(map(_width_of, text))


def _width_of(character: str) -> int:
    if category(character) in {"Mn", "Me"}:
        return 0
    if east_asian_width(character) in {"W", "F"}:
        return 2
    return len(_shown(character))
