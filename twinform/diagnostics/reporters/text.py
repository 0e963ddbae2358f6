"""The report for people: one line for each finding, with what belongs to it indented below."""

from collections.abc import Callable, Iterator, Sequence

from twinform.diagnostics.diagnostic import Diagnostic
from twinform.diagnostics.location import Location
from twinform.diagnostics.reporters.findings import Findings
from twinform.diagnostics.rule import Severity

Paint = Callable[[str, Severity], str]
"""Gives a word the color of a severity."""


def text(files: Sequence[Findings], paint: Paint = lambda word, _: word) -> str:
    """`file:line: severity: headline [rule]`, then the XML path, related places and help; empty without findings."""
    return "".join(
        f"{line}\n" for file in files for each in file.diagnostics for line in _lines(each, file.path, paint)
    )


def _lines(diagnostic: Diagnostic, file: str, paint: Paint) -> Iterator[str]:
    where, severity = diagnostic.location, diagnostic.severity
    headline = printable(diagnostic.message.strip())
    yield f"{_place(where, file)}: {paint(str(severity), severity)}: {headline} [{diagnostic.rule.name}]"
    if where.path:
        yield f"    at {printable(where.path)}"
    for other in diagnostic.related:
        yield f"    see {_place(other, file)}{f': {printable(other.path)}' if other.path else ''}"
    for number, line in enumerate((diagnostic.help or "").splitlines()):
        yield f"    {'      ' if number else 'help: '}{printable(line)}"


def _place(location: Location, file: str) -> str:
    name = printable(location.file or file)
    return f"{name}:{location.line}" if location.line else name


def printable(text: str) -> str:
    """The text with an escape for all that a terminal would obey or could not show; names come from hostile files."""
    if text.isprintable():
        return text
    return "".join(each if each.isprintable() else each.encode("unicode_escape").decode() for each in text)
