"""The one place where commands print: texts and findings for people, with nothing in them that a terminal obeys.

Names of files and texts in models and configurations may contain characters that move the cursor, set the title of a
window, or reverse text. Documents for programs are printed as they are.
"""

import io
import os
import sys
from types import TracebackType
from typing import TYPE_CHECKING, Literal

import click

from twinform.diagnostics import Severity
from twinform.diagnostics.reporters import NO_TEXTS, FileFindings, concise, printable, text

if TYPE_CHECKING:
    from twinform.compiler.input.finding_spans import SourceFiles


Color = Literal["cyan", "red", "yellow"]
_LAYOUT = frozenset("\n\t")
# Marks of styles until the text is escaped: surrogates, which no file name and no XML can contain.
_END = "\ud800"
_BOLD = "\ud801"
_COLORS: dict[Color, str] = {"cyan": "\ud802", "red": "\ud803", "yellow": "\ud804"}
_SEQUENCES = {
    _END: "\x1b[0m",
    _BOLD: "\x1b[1m",
    _COLORS["cyan"]: "\x1b[36;1m",
    _COLORS["red"]: "\x1b[31;1m",
    _COLORS["yellow"]: "\x1b[33;1m",
}


def styled(words: str, color: Color | None = None) -> str:
    """Mark words as bold, and with a color if one is given, for `print_text`."""
    return f"{_COLORS[color] if color else _BOLD}{words}{_END}"


def print_text(text: str, *, err: bool = False, nl: bool = True) -> None:
    """Print a text for people, and escape each character that a terminal would obey or cannot show.

    Styles are left out if the output is no terminal, or if the variable NO_COLOR is set.
    """
    encoding = getattr(sys.stderr if err else sys.stdout, "encoding", None) or "utf-8"
    # Escaping where a name is printed gets forgotten somewhere, so a test makes sure that commands
    # print through this module alone. The diff of a file with such characters cannot be applied as
    # printed; -o and --in-place are for that.
    safe = text if text.isprintable() else text.translate({ord(each): _escape(each) for each in set(text)})
    click.echo(safe.encode(encoding, "backslashreplace").decode(encoding), err=err, nl=nl)


def print_line(line: str, *, err: bool = False) -> None:
    """Print a text for people as one line, whatever names are in it."""
    print_text(printable(line), err=err)


def print_document(document: str | bytes) -> None:
    """Print a document for programs on standard output, in UTF-8 whatever the encoding of the terminal."""
    click.echo(document.encode(errors="backslashreplace") if isinstance(document, str) else document, nl=False)


def print_report(report: str, style: str) -> None:
    """Print a report, which is for people if its style is `text`, else for programs."""
    if style == "text":
        print_text(report, nl=False)
    else:
        print_document(report)


def print_error(error: click.ClickException) -> None:
    """Print the error that ends a command, with the usage if it is about that."""
    with io.StringIO() as text:
        error.show(text)
        shown, message = text.getvalue(), error.format_message()
    if not isinstance(error, click.BadParameter):  # errors in pipelines have lines that point at a character
        shown = shown.replace(message, printable(message))
    print_text(shown, err=True, nl=False)


def print_traceback(kind: type[BaseException], error: BaseException, where: TracebackType | None) -> None:
    """Print an uncaught exception, as `sys.excepthook` does."""
    import traceback  # noqa: PLC0415 - it should never be needed

    print_text("".join(traceback.format_exception(kind, error, where)), err=True, nl=False)


def _escape(character: str) -> str:
    if character in _SEQUENCES:
        return "" if os.environ.get("NO_COLOR") else _SEQUENCES[character]
    return character if character in _LAYOUT else printable(character)


_SEVERITY_COLORS: dict[Severity, Color] = {Severity.ERROR: "red", Severity.WARNING: "yellow", Severity.INFO: "cyan"}


def paint(word: str, severity: Severity) -> str:
    """Color a word by severity."""
    return styled(word, _SEVERITY_COLORS[severity])


notes_option = click.option(
    "--notes", is_flag=True, help="Print notes too, which say what is legal and yet worth knowing."
)


all_option = click.option("--all", "every", is_flag=True, help="Print each finding, also where several have one cause.")


def show(
    findings: FileFindings,
    *,
    notes: bool,
    on_stderr: bool,
    every: bool = False,
    short: bool = False,
    files: "SourceFiles | None" = None,
) -> None:
    """Print the findings of one file for people, with excerpts of the files.

    `notes` prints notes too, `every` each finding of one cause, and `short` one line for each without excerpts.
    """
    if not notes:
        worse = tuple(each for each in findings.diagnostics if each.severity > Severity.INFO)
        findings = findings._replace(diagnostics=worse)
    if findings.diagnostics:
        found = [locate(findings, files) if findings.texts is NO_TEXTS else findings]
        report = concise(found, paint) if short else text(found, paint, every=every)
        print_text(report, nl=False, err=on_stderr)


def locate(findings: FileFindings, files: "SourceFiles | None" = None) -> FileFindings:
    """Add columns and the texts of the files to findings; without findings nothing is read."""
    if not findings.diagnostics:
        return findings
    # only findings have places
    from twinform.compiler.input.finding_spans import SourceFiles, with_columns  # noqa: PLC0415 - see above

    files = files or SourceFiles()
    return FileFindings(findings.path, with_columns(findings.diagnostics, files), files)
