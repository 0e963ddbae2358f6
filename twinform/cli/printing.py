"""The one place where commands print: texts for people, which cannot drive the terminal, and documents as they are.

Names of files, and whatever stands in models and configurations, may hold characters that move the cursor, set the
title of a window, or turn text around.
"""

import io
import os
import sys
from types import TracebackType
from typing import Literal

import click

from twinform.diagnostics.reporters import printable

Color = Literal["cyan", "red", "yellow"]
_LAYOUT = frozenset("\n\t")
# where a style begins and ends, until the text has been escaped: surrogates that no name of a file and no XML can have
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
    """Return words for `print_text` that are bold, and have a color if one is given."""
    return f"{_COLORS[color] if color else _BOLD}{words}{_END}"


def print_text(text: str, *, err: bool = False, nl: bool = True) -> None:
    """Print a text for people, with an escape for each character that a terminal would obey or cannot show.

    Styles are left out where the output is no terminal, and where the variable NO_COLOR is set.
    """
    encoding = getattr(sys.stderr if err else sys.stdout, "encoding", None) or "utf-8"
    # A file name can hold the sequence that sets the title of a terminal. Escaping at each place
    # that prints a name gets forgotten somewhere, so commands print through this module alone, and
    # a test holds them to it. A diff of such a file cannot be applied as printed; -o and --in-place
    # are for that.
    safe = text if text.isprintable() else "".join(map(_escape, text))
    click.echo(safe.encode(encoding, "backslashreplace").decode(encoding), err=err, nl=nl)


def print_line(line: str, *, err: bool = False) -> None:
    """Print a text for people in one line, whatever names are in it."""
    print_text(printable(line), err=err)


def print_document(document: str | bytes) -> None:
    """Print a document for programs on standard output: UTF-8, whatever the terminal's encoding is."""
    click.echo(document.encode(errors="backslashreplace") if isinstance(document, str) else document, nl=False)


def print_report(report: str, style: str) -> None:
    """Print a report whose style is `text`, for people, or the name of a format for programs."""
    if style == "text":
        print_text(report, nl=False)
    else:
        print_document(report)


def print_error(error: click.ClickException) -> None:
    """Print what ends a command, with the usage where it is about that."""
    with io.StringIO() as text:
        error.show(text)
        shown, message = text.getvalue(), error.format_message()
    if not isinstance(error, click.BadParameter):  # one about a pipeline points at a character, in lines
        shown = shown.replace(message, printable(message))
    print_text(shown, err=True, nl=False)


def print_traceback(kind: type[BaseException], error: BaseException, where: TracebackType | None) -> None:
    """Print an exception that nothing has caught, as `sys.excepthook` does."""
    import traceback  # noqa: PLC0415 - it should never be needed

    print_text("".join(traceback.format_exception(kind, error, where)), err=True, nl=False)


def _escape(character: str) -> str:
    if character in _SEQUENCES:
        return "" if os.environ.get("NO_COLOR") else _SEQUENCES[character]
    return character if character in _LAYOUT else printable(character)
