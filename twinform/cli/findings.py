"""Prints findings on a terminal, in color where it has any."""

import os

import click

from twinform.diagnostics import Severity
from twinform.diagnostics.reporters import Findings, text

_COLORS = {Severity.ERROR: "red", Severity.WARNING: "yellow", Severity.INFO: "cyan"}


def paint(word: str, severity: Severity) -> str:
    """The word in its color. click takes the color away where the output is no terminal."""
    return word if os.environ.get("NO_COLOR") else click.style(word, fg=_COLORS[severity], bold=True)


def heading(words: str) -> str:
    """The text as a heading."""
    return words if os.environ.get("NO_COLOR") else click.style(words, bold=True)


notes_option = click.option(
    "--notes", is_flag=True, help="Print notes too, which say what is legal and yet worth knowing."
)


def show(findings: Findings, *, notes: bool, on_stderr: bool) -> None:
    """Print the findings of one file for people; notes only where they are asked for."""
    if not notes:
        worse = tuple(each for each in findings.diagnostics if each.severity > Severity.INFO)
        findings = findings._replace(diagnostics=worse)
    click.echo(text([findings], paint), nl=False, err=on_stderr)
