"""`twinform format`."""

from collections import Counter
from pathlib import Path
from typing import Any, Literal

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command, Unusable
from twinform.cli.completion import files as files_of
from twinform.cli.config_defaults import config_options
from twinform.cli.config_file import ConfigError
from twinform.cli.diagnostic_rows import diagnostic_of_row, row_of_diagnostic
from twinform.cli.file_runs import RunOptions, open_file_run, run_options
from twinform.cli.inputs import InputSource, exclude_options, exclusion_of, model_inputs, size_option
from twinform.cli.model_files import is_text
from twinform.cli.nearest_projects import ContextByFile, finding_of
from twinform.cli.printing import print_document, print_line, print_text, show
from twinform.compiler import CompileError
from twinform.compiler.formatting import formatted
from twinform.compiler.input.parsing import UnreadableError, read_bytes
from twinform.compiler.input.size_limits import LARGEST, USUAL_LIMITS, Limits
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Location, Severity, rules
from twinform.diagnostics.reporters import FileFindings
from twinform.diagnostics.wording import plural
from twinform.option import given
from twinform.text import SourceText
from twinform.text.formatting import FormatOptions
from twinform.text.source_text import line_diff

_BYTES = "latin-1"
"""The encoding in which every byte is a character."""


@dataclass(frozen=True, slots=True)
class FormattedFile:
    """The bytes of a file before and after, or the findings because of which there are none."""

    before: bytes = b""
    after: bytes = b""
    findings: tuple[Diagnostic, ...] = ()

    @classmethod
    def failed(cls, path: str, why: str) -> "FormattedFile":
        """Make the result for a file whose formatting has ended its process or did not come to an end."""
        message = f"the file could not be formatted: {why}"
        return cls(findings=(Diagnostic(rules.UNREADABLE_FILE, message, Location(path), Severity.ERROR),))

    def to_json(self) -> list[Any]:
        """Return the result as lists and texts."""
        after = None if self.after == self.before else self.after.decode(_BYTES)
        return [self.before.decode(_BYTES), after, [row_of_diagnostic(each) for each in self.findings]]

    @classmethod
    def from_json(cls, row: list[Any]) -> "FormattedFile":
        """Make a result of what `to_json` has returned."""
        before, after, findings = row
        data = before.encode(_BYTES)
        return cls(data, data if after is None else after.encode(_BYTES), tuple(map(diagnostic_of_row, findings)))


@dataclass(frozen=True, slots=True)
class FormatTask:
    """The formatting of one file."""

    source: InputSource
    options: FormatOptions
    limits: Limits
    problem: Diagnostic | None = None

    @property
    def name(self) -> str:
        """The path of the file."""
        return self.source.name

    @property
    def is_kept(self) -> bool:
        """Whether the result depends on files, options and our code alone: always."""
        return True

    @property
    def seconds(self) -> float:
        """How long it takes, as measured over the corpus."""
        return 0.003

    def do(self) -> FormattedFile:
        """Format the file, unless there is a problem with the settings for it."""
        if self.problem:
            return FormattedFile(findings=(self.problem,))
        try:
            before = self._read()
            return FormattedFile(before, formatted(before, self.name, self.options, self.limits))
        except CompileError as error:
            return FormattedFile(findings=error.diagnostics)

    def _read(self) -> bytes:
        """Read the file.

        Raises:
            CompileError: it cannot be read.
        """
        if isinstance(self.source.content, bytes):
            return self.source.content
        sink = DiagnosticSink(self.name)
        try:
            return read_bytes(Path(self.source.content), sink, self.limits)
        except UnreadableError as error:
            raise CompileError(tuple(sink.diagnostics), unreadable=True) from error


_WIDEST = 16


class _Indent(click.ParamType):  # pyright: ignore[reportMissingTypeArgument] - click before 8.2 has no such argument
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
@run_options
@size_option
@config_options
@click.pass_context
def command(
    ctx: click.Context,
    files: tuple[str, ...],
    *,
    check: bool,
    diff: bool,
    exclude: tuple[str, ...],
    force_exclude: bool,
    run: RunOptions,
    **_options: object,
) -> None:
    """Format the text of models, and change nothing else.

    IN are URDF, SDF, MJCF, xacro and other XML files, folders of them, or globs in quotes, and are written anew where
    they change; - is standard input, which goes to standard output. Comments and texts, and what they mean, stay as
    they are. The nearest twinform.toml of each file says how. Exit code: 0 formatted, 1 with --check or --diff where
    something would change, 2 where a file could not be read or written, or is no XML.
    """
    contexts = ContextByFile(ctx)
    file_run = open_file_run("format", files, run)
    sources, _ = model_inputs(files, exclusion_of(ctx, exclude, force=force_exclude), is_text, file_run.remember)
    report = _FormatReport(check=check, diff=diff)
    found = Counter[Outcome]()
    with file_run.on(FormattedFile, [_task(source, contexts) for source in sources]) as results:
        for source, made in zip(sources, results, strict=True):
            found[report.file(source, made)] += 1
    file_run.end()
    print_line(report.summary(found), err=True)
    would_change = (check or diff) and found["changed"]
    ctx.exit(UNUSABLE if found["unusable"] else FINDINGS if would_change else 0)


def _task(source: InputSource, contexts: ContextByFile) -> FormatTask:
    """Return the formatting of a file by its configuration; where that is wrong, the file stays as it is."""
    try:
        given_options = contexts.of(source.name).params
    except ConfigError as error:
        return FormatTask(source, FormatOptions(), USUAL_LIMITS, finding_of(error, source.name))
    options = FormatOptions(given_options["indent"], given_options["numbers"], given_options["sort_attributes"])
    return FormatTask(source, options, Limits(given(given_options["max_size"], LARGEST)))


Outcome = Literal["changed", "same", "unusable"]


class _FormatReport:
    """Writes what has changed, or prints it."""

    def __init__(self, *, check: bool, diff: bool) -> None:
        self.check, self.diff = check, diff

    def file(self, source: InputSource, made: FormattedFile) -> Outcome:
        """Write a formatted file, or print what would change in it."""
        if made.findings:
            show(FileFindings(source.name, made.findings), notes=False, on_stderr=True)
            return "unusable"
        before, after = made.before, made.after
        if self.check or self.diff:
            self._print_changes(source, before, after)
        elif isinstance(source.content, bytes):
            print_document(after)
        elif not _write(source, before, after):
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


def _write(source: InputSource, before: bytes, after: bytes) -> bool:
    """Write a file; return whether that worked."""
    from twinform.cli.outputs import Rewrite, write_back  # noqa: PLC0415 - `--check` and `--diff` write nothing

    try:
        write_back([Rewrite(source, before, after)])
    except Unusable as error:
        print_line(f"Error: {error.message}", err=True)
        return False
    return True
