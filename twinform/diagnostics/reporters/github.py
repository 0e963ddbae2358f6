"""The report for GitHub: workflow commands, which it shows as annotations beside the lines of a change."""

from collections.abc import Sequence

from twinform.diagnostics.diagnostic import Diagnostic, Location, Severity
from twinform.diagnostics.reporters.file_findings import FileFindings, printable

_COMMANDS = {Severity.ERROR: "error", Severity.WARNING: "warning", Severity.INFO: "notice"}

# `%` comes first: the escapes themselves begin with it. Properties are parted by `,` and `:` ends them.
_IN_DATA = (("%", "%25"), ("\r", "%0D"), ("\n", "%0A"))
_IN_PROPERTIES = (*_IN_DATA, (":", "%3A"), (",", "%2C"))


def github(files: Sequence[FileFindings]) -> str:
    """`::error file=,line=,col=,endLine=,endColumn=,title=::message`, a line for each finding; empty without any."""
    return "".join(f"{_command(each, file.path)}\n" for file in files for each in file.diagnostics)


def _command(diagnostic: Diagnostic, file: str) -> str:
    where = diagnostic.location
    properties = {
        "file": where.file or file,
        "line": str(where.line or ""),
        **_end_fields(where),
        "title": diagnostic.rule.name,
    }
    listed = ",".join(
        f"{key}={_escape(printable(value), _IN_PROPERTIES)}" for key, value in properties.items() if value
    )
    parts = (diagnostic.message, where.path and f"at {where.path}", diagnostic.help and f"help: {diagnostic.help}")
    message = _escape("\n".join(part for part in parts if part), _IN_DATA)
    return f"::{_COMMANDS[diagnostic.severity]} {listed}::{message}"


def _end_fields(where: Location) -> dict[str, str]:
    """Return the end of a piece for GitHub, which shows pieces of a single line only."""
    if where.end_line > where.line:
        return {"endLine": str(where.end_line)}
    end = {"endLine": str(where.end_line), "endColumn": str(where.end_column)} if where.end_line else {}
    return {"col": str(where.column), **end} if where.column else {}


def _escape(text: str, table: tuple[tuple[str, str], ...]) -> str:
    for character, code in table:
        text = text.replace(character, code)
    return printable(text)  # the log is shown in terminals too
