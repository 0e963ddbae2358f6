"""Findings on a terminal."""

import os

import click

from twinform.diagnostics import Severity
from twinform.diagnostics.reporters import Findings, text

_COLOURS = {Severity.ERROR: "red", Severity.WARNING: "yellow", Severity.INFO: "cyan"}


def paint(word: str, severity: Severity) -> str:
    """The word in its colour. click takes the colour away where the output is no terminal."""
    return word if os.environ.get("NO_COLOR") else click.style(word, fg=_COLOURS[severity], bold=True)


def heading(words: str) -> str:
    """The words as a heading."""
    return words if os.environ.get("NO_COLOR") else click.style(words, bold=True)


def show(findings: Findings, *, on_stderr: bool) -> None:
    """Print the findings of one file for people."""
    click.echo(text([findings], paint), nl=False, err=on_stderr)
