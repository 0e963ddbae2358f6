"""`twinform fix`, and the fixes of `check --fix`: their options, and the messages about them."""

from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command, Unusable
from twinform.cli.completion import files, pipelines
from twinform.cli.inputs import InputSource, exclude_options, exclusion_of, file_options, model_inputs
from twinform.cli.instrumentation import mesh_progress
from twinform.cli.model_files import is_plain
from twinform.cli.outputs import Rewrite, show_differences, write_back
from twinform.cli.printing import notes_option, plural, print_line, show
from twinform.cli.project_options import OptionsByFile, pipeline_option
from twinform.cli.rule_options import policy_options
from twinform.compiler import (
    CompileError,
    ConversionRequest,
    Language,
    LoadOptions,
    LoadResult,
    as_refused,
    inspect,
    read,
)
from twinform.compiler.fixing import ANOTHER_ROBOT, FixResult, Refused, apply_fixes_by
from twinform.compiler.in_place import convert_in_place
from twinform.compiler.input.load_options import XACRO
from twinform.compiler.input.parsing import UnreadableError, read_bytes
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic, DiagnosticSink, Policy, Safety, Severity
from twinform.diagnostics.reporters import FileFindings
from twinform.passes import FilesPass, PassError, Pipeline

Look = Callable[[str | bytes, str], LoadResult]
"""Checks a file, or the bytes of one under its name."""


@dataclass(frozen=True, slots=True)
class Fixing:
    """How files are fixed; with `diff` nothing is written, and notes are fixed only with `notes`."""

    look: Look
    load_options: LoadOptions
    policy: Policy
    unsafe: bool = False
    diff: bool = False
    notes: bool = False

    def wants(self, finding: Diagnostic) -> bool:
        """Whether a finding is shown, and so may be fixed."""
        # A command that changes a file for a reason that it does not print would surprise.
        return bool(self.policy.apply([finding])) and (self.notes or finding.severity > Severity.INFO)


class FixedSource(NamedTuple):
    """A fixed file: its findings now, its new text, messages about the fixes, and their number."""

    loaded: LoadResult
    rewrite: Rewrite | None
    news: list[str]
    number: int


def run_fixes(sources: Sequence[InputSource], fixing: Callable[[InputSource], Fixing]) -> tuple[list[LoadResult], int]:
    """Fix files, and write them or print what would change; return their findings then, and the number of fixes.

    Raises:
        Unusable: a file cannot be written.
    """
    ways = [fixing(each) for each in sources]
    done = [fix_source(each, way) for each, way in zip(sources, ways, strict=True)]
    rewrites = [each.rewrite for each in done if each.rewrite]
    if any(way.diff for way in ways):
        show_differences(rewrites)
    else:
        write_back(rewrites)
    for line in (line for each in done for line in each.news):
        print_line(line, err=True)
    return [each.loaded for each in done], sum(each.number for each in done)


def fix_source(source: InputSource, fixing: Fixing) -> FixedSource:
    """Fix a file without writing it; a file that cannot be fixed, such as xacro, is only checked."""
    sink = DiagnosticSink(source.name)
    try:
        data = _read_fixable(source, sink, fixing.load_options)
    except UnreadableError:
        return FixedSource(LoadResult(source.name, None, tuple(sink.diagnostics), unreadable=True), None, [], 0)
    if data is None:
        return FixedSource(fixing.look(source.content, source.name), None, [], 0)
    found = apply_fixes_by(
        lambda text: fixing.look(text, source.name),
        data,
        unsafe=fixing.unsafe,
        wanted=fixing.wants,
        load_options=fixing.load_options,
    )
    rewrite = Rewrite(source, data, found.data)
    return FixedSource(
        found.left, rewrite, _describe(source.name, found, "would fix" if fixing.diff else "fixed"), len(found.applied)
    )


def _read_fixable(source: InputSource, sink: DiagnosticSink, load_options: LoadOptions) -> bytes | None:
    """Read a file that can be fixed; None for xacro, whose findings are about the expanded text.

    Raises:
        UnreadableError: it cannot be read.
    """
    if isinstance(source.content, bytes):
        return source.content
    if load_options.xacro or source.name.lower().endswith(XACRO):
        return None
    path = Path(source.content)
    return read_bytes(path, sink, load_options.limits, load_options.search.readable(path))


_MOST_SHOWN = 20


def _describe(name: str, found: FixResult, verb: str) -> list[str]:
    """Say what was fixed in a file by rule, what was guessed, how the robot differs, and what was not fixed."""
    counts = Counter(each.rule.name for each in found.applied)
    shown = ", ".join(f"{count} x {rule}" for rule, count in counts.most_common())
    lines = [f"{name}: {verb} {shown}"] if counts else []
    guesses = [each for each in found.applied if each.fix and each.fix.safety is not Safety.SAFE]
    lines += _first(name, [f"unsafe: {_title(each)}" for each in guesses])
    lines += _first(name, [f"the robot differs: {each}" for each in found.changes])
    return lines + _first(name, [f"not fixed: {_title(each.finding)}: {_reason(each)}" for each in found.refused])


def _title(finding: Diagnostic) -> str:
    title = finding.fix.title if finding.fix else finding.message
    return f"line {finding.location.line}: {title} [{finding.rule.name}]"


def _reason(refused: Refused) -> str:
    if refused.new == (ANOTHER_ROBOT,):
        return "another robot would come of it"
    return f"{', '.join(refused.new)} would be found then"


def _first(name: str, lines: list[str]) -> list[str]:
    more = [f"{name}: and {len(lines) - _MOST_SHOWN} more"] if len(lines) > _MOST_SHOWN else []
    return [*(f"{name}: {line}" for line in lines[:_MOST_SHOWN]), *more]


Report = Callable[[str, tuple[Diagnostic, ...]], None]
"""Prints the findings of a file."""


EXAMPLES = {
    "Fix what can be fixed": "twinform fix robot.urdf",
    "Show what a guess would change too": "twinform fix robot.urdf --unsafe-fixes --diff",
    "Run a pass on a file": "twinform fix robot.urdf --passes 'fill-limits{effort=100}'",
}


@click.command("fix", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="IN...", nargs=-1, required=True, shell_complete=files)
@click.option(
    "--passes",
    metavar="PIPELINE",
    callback=pipeline_option("passes"),
    shell_complete=pipelines,
    help="Passes to run then, such as 'fill-limits{effort=100}', or @NAME for one that the configuration names.",
)
@click.option("--unsafe-fixes", is_flag=True, help="Fix what is a guess too, or may make another robot of a file.")
@click.option("--diff", is_flag=True, help="Print what would change, and write nothing; exit code 1 if anything.")
@notes_option
@policy_options
@exclude_options
@file_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    passes: Pipeline | None,
    *,
    unsafe_fixes: bool,
    diff: bool,
    notes: bool,
    exclude: tuple[str, ...],
    force_exclude: bool,
    **_options: object,
) -> None:
    """Fix robot models in their files, and run passes on them.

    IN are URDF or SDF files, folders of them, or globs in quotes; - is standard input, which goes to standard output.
    Only what a fix or a pass changes is changed: comments, layout and the spelling of all else stay. All is written,
    or, where a pass cannot run, nothing. Exit code: 0 where all went well, 1 with errors, 2 where a file could not be
    read or written.
    """
    sources, arguments = model_inputs(words, exclusion_of(ctx, exclude, force=force_exclude), is_plain)
    by_file = OptionsByFile(ctx, arguments)

    def look(content: str | bytes, name: str) -> LoadResult:
        load_options = by_file.of(name).load_options
        return as_refused(inspect(read(content, load_options, name=name), load_options))

    def report(name: str, diagnostics: tuple[Diagnostic, ...]) -> None:
        show(FileFindings(name, by_file.of(name).policy.apply(diagnostics)), notes=notes, on_stderr=True)

    def fixing(source: InputSource) -> Fixing:
        own = by_file.of(source.name)
        return Fixing(look, own.load_options, own.policy, unsafe=unsafe_fixes, diff=diff, notes=notes)

    for source in sources:
        _require_model(source, passes)
    runs = [_run(source, passes, fixing(source), report) for source in sources]
    rewrites = [each for each in runs if isinstance(each, Rewrite)]
    if len(rewrites) < len(runs):
        if len(runs) > 1:
            wrong = len(runs) - len(rewrites)
            print_line(f"nothing is written: {wrong} of {len(runs)} files could not be changed", err=True)
        ctx.exit(max(each for each in runs if isinstance(each, int)))
    if diff:
        ctx.exit(FINDINGS if show_differences(rewrites) else 0)
    write_back(rewrites)


def _require_model(source: InputSource, passes: Pipeline | None) -> None:
    """Require a model whose own text can be changed.

    Raises:
        click.UsageError: it is JSON or xacro, or a pass makes other files.
    """
    if source.format == "json" or source.name.lower().endswith(XACRO):
        raise click.UsageError(f"{source.name} is not URDF or SDF: change it by hand, or convert it first")
    made = [step.only_file for step in passes or () if isinstance(step, FilesPass) and step.only_file]
    if made:
        raise click.UsageError(f"a pass writes {made[0]} beside the result: give it to convert")


def _run(source: InputSource, passes: Pipeline | None, fixing: Fixing, report: Report) -> Rewrite | int:
    """Fix a file and run passes on it; return the new text, or the exit code if it cannot be changed."""
    fixed = fix_source(source, fixing)
    rewrite, news = fixed.rewrite, fixed.news
    if rewrite is None or fixed.loaded.unreadable:
        report(source.name, fixed.loaded.diagnostics)
        return UNUSABLE
    if passes:
        try:
            request = ConversionRequest(to=_format_of(rewrite), passes=passes)
            with mesh_progress(passes):
                updated = convert_in_place(request, source.name, fixing.load_options, data=rewrite.after)
        except CompileError as error:
            report(source.name, error.diagnostics)
            return UNUSABLE if error.unreadable else FINDINGS
        except PassError as error:
            raise Unusable(str(error)) from error
        report(source.name, updated.conversion.diagnostics)
        rewrite = Rewrite(source, rewrite.before, updated.data, updated.conversion.side_files)
        news = [*news, f"{source.name}: {plural(len(updated.changes), 'change')} by passes"]
    for line in news:
        print_line(line, err=True)
    return rewrite


def _format_of(rewrite: Rewrite) -> Language:
    """Return the format of a file."""
    return "urdf" if InputSource(rewrite.after, rewrite.source.name).format == "urdf" else "sdf"
