"""`twinform fix`."""

from collections.abc import Callable

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command, Unusable
from twinform.cli.completion import files, pipelines
from twinform.cli.config.config_defaults import RuleSettings
from twinform.cli.fixing import Fixing, fix_source
from twinform.cli.inputs import InputSource, exclude_options, exclusion_of, file_options, load_options_of, model_inputs
from twinform.cli.mesh_progress import mesh_progress
from twinform.cli.model_files import is_plain
from twinform.cli.printing import notes_option, plural, print_line, show
from twinform.cli.project_options import pipeline_option, policy_of, policy_options
from twinform.cli.rewriting import Rewrite, show_differences, write_back
from twinform.compiler import CompileError, ConversionRequest, Language, LoadResult, inspect, read
from twinform.compiler.in_place import convert_in_place
from twinform.compiler.input.load_options import FileOptions
from twinform.diagnostics import Diagnostic
from twinform.diagnostics.reporters import FileFindings
from twinform.passes import PassError, Pipeline, SideFilePass

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
    rules: RuleSettings,
    exclude: tuple[str, ...],
    force_exclude: bool,
    reading: FileOptions,
) -> None:
    """Fix robot models in their files, and run passes on them.

    IN are URDF or SDF files, folders of them, or globs in quotes; - is standard input, which goes to standard output.
    Only what a fix or a pass changes is changed: comments, layout and the spelling of all else stay. All is written,
    or, where a pass cannot run, nothing. Exit code: 0 where all went well, 1 with errors, 2 where a file could not be
    read or written.
    """
    sources, arguments = model_inputs(words, exclusion_of(ctx, exclude, force=force_exclude), is_plain)
    policy, load_options = policy_of(ctx, rules), load_options_of(arguments, reading)

    def look(content: str | bytes, name: str) -> LoadResult:
        return inspect(read(content, load_options, name=name), load_options)

    def report(name: str, diagnostics: tuple[Diagnostic, ...]) -> None:
        show(FileFindings(name, policy.apply(diagnostics)), notes=notes, on_stderr=True)

    for source in sources:
        _require_model(source, passes)
    fixing = Fixing(look, load_options, policy, unsafe=unsafe_fixes, diff=diff, notes=notes)
    runs = [_run(source, passes, fixing, report) for source in sources]
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
    if source.format == "json" or source.name.lower().endswith(".xacro"):
        raise click.UsageError(f"{source.name} is not URDF or SDF: change it by hand, or convert it first")
    made = [step.file for step in passes or () if isinstance(step, SideFilePass)]
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
