"""Prints findings on a terminal, in color where it has any."""

from typing import TYPE_CHECKING

import click

from twinform.cli.printing import Color, print_text, styled
from twinform.diagnostics import Severity
from twinform.diagnostics.reporters import FileFindings, concise, text

if TYPE_CHECKING:
    from twinform.compiler.input.source_files import SourceFiles

_COLORS: dict[Severity, Color] = {Severity.ERROR: "red", Severity.WARNING: "yellow", Severity.INFO: "cyan"}


def paint(word: str, severity: Severity) -> str:
    """The word in its color."""
    return styled(word, _COLORS[severity])


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
    """Print the findings of one file for people, with the pieces of the files that they are about.

    Notes are printed only where they are asked for, and each finding of one cause only where `every` one is. What is
    `short` has a line for each.
    """
    if not notes:
        worse = tuple(each for each in findings.diagnostics if each.severity > Severity.INFO)
        findings = findings._replace(diagnostics=worse)
    if findings.diagnostics:
        found = [placed(findings, files)]
        report = concise(found, paint) if short else text(found, paint, every=every)
        print_text(report, nl=False, err=on_stderr)


def placed(findings: FileFindings, files: "SourceFiles | None" = None) -> FileFindings:
    """The findings with columns, and with the texts that they are about; without findings nothing is read."""
    if not findings.diagnostics:
        return findings
    # positions are for files with findings
    from twinform.compiler.input.finding_spans import with_columns  # noqa: PLC0415 - see above
    from twinform.compiler.input.source_files import SourceFiles  # noqa: PLC0415 - see above

    files = files or SourceFiles()
    return FileFindings(findings.path, with_columns(findings.diagnostics, files), files)
