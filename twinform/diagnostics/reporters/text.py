"""The report for people: each finding with the piece of the file that it is about."""

from collections.abc import Callable, Iterator, Sequence

from twinform.diagnostics.diagnostic import Diagnostic
from twinform.diagnostics.location import Location
from twinform.diagnostics.reporters.excerpt import excerpt
from twinform.diagnostics.reporters.file_findings import FileFindings
from twinform.diagnostics.reporters.grouping import Group, grouped
from twinform.diagnostics.reporters.printable import printable
from twinform.diagnostics.rule import Severity

Paint = Callable[[str, Severity], str]
"""Gives a word the color of a severity."""
_SHOWN = 3
"""So many places of one cause are named."""


def _plain(word: str, _: Severity) -> str:
    return word


def text(files: Sequence[FileFindings], paint: Paint = _plain, *, every: bool = False) -> str:
    """`file:line:column: severity: headline [rule]`, then XML path, source line, related places, help and fix.

    Findings of one cause are one, with a count, unless `every` one is wanted. Empty without findings.
    """
    return "".join(
        f"{line}\n"
        for file in files
        for group in grouped(file.diagnostics, every=every)
        for line in _lines_of_group(group, file, paint)
    )


def concise(files: Sequence[FileFindings], paint: Paint = _plain) -> str:
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
