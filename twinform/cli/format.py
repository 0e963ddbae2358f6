"""`twinform format`."""

from collections import Counter
from pathlib import Path
from typing import Literal

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command, Unusable
from twinform.cli.completion import files as files_of
from twinform.cli.config import config_options
from twinform.cli.inputs import InputSource, exclude_options, exclusion_of, model_inputs, size_option
from twinform.cli.model_files import is_text
from twinform.cli.printing import plural, print_document, print_line, print_text, show
from twinform.cli.rewriting import Rewrite, write_back
from twinform.compiler import CompileError
from twinform.compiler.formatting import formatted
from twinform.compiler.input.parsing import UnreadableError, read_bytes
from twinform.compiler.input.size_limits import LARGEST, Limits
from twinform.compiler.option import given
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.reporters import FileFindings
from twinform.text import SourceText
from twinform.text.formatting import FormatOptions
from twinform.text.source_text import line_diff

_WIDEST = 16


class _Indent(click.ParamType[str]):
    """The indentation of a level: a number of blanks, or `tab`."""

    name = "indent"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Convert to the text that indents a level."""
        if str(value) == "tab":
            return "\t"
        if not (str(value).isdecimal() and int(str(value)) <= _WIDEST):
            self.fail(f"{value!r} is neither a number from 0 to {_WIDEST} nor 'tab'", param, ctx)
        return " " * int(str(value))


EXAMPLES = {
    "Format a file": "twinform format robot.urdf",
    "Show what would change": "twinform format robot.urdf robot.sdf --diff",
    "All below a folder": "twinform format .",
    "Fail where a file is not formatted, as in CI": "twinform format robot.sdf --check",
    "Write numbers as short as they can be": "twinform format robot.urdf --numbers shortest",
}


@click.command("format", cls=Command, examples=EXAMPLES)
@click.argument("files", metavar="IN...", nargs=-1, required=True, shell_complete=files_of)
@click.option("--check", is_flag=True, help="Write nothing; list the files that are not formatted, and exit with 1.")
@click.option("--diff", is_flag=True, help="Write nothing; print what would change, and exit with 1 if anything would.")
@click.option(
    "--indent", type=_Indent(), metavar="N|tab", default="2", help="Blanks for each level, or tab; by default 2."
)
@click.option(
    "--numbers",
    type=click.Choice(["kept", "shortest"]),
    default="kept",
    help="Whether numbers keep their spelling, or get the shortest one of the same value.",
)
@click.option("--sort-attributes/--no-sort-attributes", help="Put attributes into their usual order.")
@exclude_options
@size_option
@config_options
@click.pass_context
def command(
    ctx: click.Context,
    files: tuple[str, ...],
    *,
    check: bool,
    diff: bool,
    indent: str,
    numbers: Literal["kept", "shortest"],
    sort_attributes: bool,
    exclude: tuple[str, ...],
    force_exclude: bool,
    max_size: int | None,
) -> None:
    """Lay out the text of models, and change nothing else.

    IN are URDF, SDF, xacro and other XML files, folders of them, or globs in quotes, and are written anew where they
    change; - is standard input, which goes to standard output. Comments and texts, and what they mean, stay as they
    are. Exit code: 0 formatted, 1 with --check or --diff where something would change, 2 where a file could not be read
    or written, or is no XML.
    """
    options, limits = FormatOptions(indent, numbers, sort_attributes), Limits(given(max_size, LARGEST))
    run = _FormatRun(options, limits, check=check, diff=diff)
    sources, _ = model_inputs(files, exclusion_of(ctx, exclude, force=force_exclude), is_text)
    found = Counter[Outcome](map(run.file, sources))
    print_line(run.summary(found), err=True)
    would_change = (check or diff) and found["changed"]
    ctx.exit(UNUSABLE if found["unusable"] else FINDINGS if would_change else 0)


Outcome = Literal["changed", "same", "unusable"]


class _FormatRun:
    """One call of the command."""

    def __init__(self, options: FormatOptions, limits: Limits, *, check: bool, diff: bool) -> None:
        self.options, self.limits, self.check, self.diff = options, limits, check, diff

    def file(self, source: InputSource) -> Outcome:
        """Format a file, or print what would change in it."""
        try:
            before = _read(source, self.limits)
            after = formatted(before, source.name, self.options, self.limits)
        except CompileError as error:
            show(FileFindings(source.name, error.diagnostics), notes=False, on_stderr=True)
            return "unusable"
        if self.check or self.diff:
            self._print_changes(source, before, after)
        elif isinstance(source.content, bytes):
            print_document(after)
        elif not _write(Rewrite(source, before, after)):
            return "unusable"
        return "same" if before == after else "changed"

    def _print_changes(self, source: InputSource, before: bytes, after: bytes) -> None:
        if self.diff:
            for line in line_diff(source.name, SourceText.of(before).text, SourceText.of(after).text):
                print_text(line, nl=False)
        elif before != after:
            print_line(source.name)

    def summary(self, found: Counter[Outcome]) -> str:
        """Say how many files were changed."""
        word = "would change" if self.check or self.diff else "formatted"
        parts = [f"{plural(found['changed'], 'file')} {word}", f"{found['same']} unchanged"]
        return ", ".join(parts) + (f", {found['unusable']} could not be formatted" if found["unusable"] else "")


def _read(source: InputSource, limits: Limits) -> bytes:
    """Read a file.

    Raises:
        CompileError: it cannot be read.
    """
    if isinstance(source.content, bytes):
        return source.content
    sink = DiagnosticSink(source.name)
    try:
        return read_bytes(Path(source.content), sink, limits)
    except UnreadableError as error:
        raise CompileError(tuple(sink.diagnostics), unreadable=True) from error


def _write(rewrite: Rewrite) -> bool:
    """Write a file; return whether that worked."""
    try:
        write_back([rewrite])
    except Unusable as error:
        print_line(f"Error: {error.message}", err=True)
        return False
    return True
