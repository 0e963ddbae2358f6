"""`twinform check`."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from twinform.cli.check_report import CheckReport, baseline_of, baseline_options
from twinform.cli.command import FINDINGS, UNUSABLE, Command, Unusable
from twinform.cli.completion import files, pipelines
from twinform.cli.config.config_defaults import RuleSettings
from twinform.cli.inputs import InputSource, exclude_options, exclusion_of, model_inputs, read_model, reading_options
from twinform.cli.printing import all_option, notes_option
from twinform.cli.project_options import OptionsByFile, consumers_option, pipeline_option, policy_options
from twinform.compiler import LoadOptions, LoadResult, ReadOnlyPassError, inspect
from twinform.compiler.input.load_options import ReadingOptions
from twinform.diagnostics.reporters import REPORTERS
from twinform.passes import PassError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from twinform.cli.fixing import Fixing
    from twinform.passes import Pipeline
    from twinform.profiles import Profile


EXAMPLES = {
    "Find mistakes": "twinform check robot.urdf",
    "Also what is legal and yet worth knowing, for a program": "twinform check robot.sdf --notes --format json",
    "Expand a xacro file with an argument of its own": "twinform check arm.urdf.xacro prefix:=left_",
    "What would these two programs make of it?": "twinform check robot.urdf --for drake,mujoco",
    "One rule is an error, another is left out": "twinform check robot.urdf --deny massless-link --allow missing-limit",
}


@click.command("check", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="IN... [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@click.option("--format", "style", type=click.Choice(list(REPORTERS)), default="text", help="How to print findings.")
@notes_option
@all_option
@policy_options
@baseline_options
@click.option(
    "--passes",
    "check_passes",
    metavar="PIPELINE",
    callback=pipeline_option("check-passes"),
    shell_complete=pipelines,
    help="Read-only passes, such as 'check-inertia,check-limits', or @NAME for one that the configuration names.",
)
@consumers_option
@exclude_options
@click.option("--watch", is_flag=True, help="Stay, and check what changes again, until Ctrl-C.")
@click.option("--fix", is_flag=True, help="Fix what can be fixed without another robot coming of it, in the files.")
@click.option("--unsafe-fixes", is_flag=True, help="Fix what is a guess too, or may make another robot of a file.")
@click.option("--diff", is_flag=True, help="Print what --fix would change, and write nothing; exit code 1 if anything.")
@click.option("--fix-only", is_flag=True, help="Fix, and report nothing of what is left.")
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    style: str,
    *,
    notes: bool,
    every: bool,
    rules: RuleSettings,
    baseline: Path | None,
    update_baseline: bool,
    check_passes: "Pipeline | None",
    profiles: "tuple[Profile, ...]",
    exclude: tuple[str, ...],
    force_exclude: bool,
    watch: bool,
    fix: bool,
    unsafe_fixes: bool,
    diff: bool,
    fix_only: bool,
    reading: ReadingOptions,
) -> None:
    """Find everything that is wrong with robot models.

    IN are URDF, SDF, xacro or JSON files, folders of them, or globs in quotes; - is standard input. Arguments of xacro
    are written NAME:=VALUE. Exit code: 0 without errors, 1 with errors, 2 where a file could not be read.
    """
    exclusion = exclusion_of(ctx, exclude, force=force_exclude)
    sources, arguments = model_inputs(words, exclusion)
    options = OptionsByFile(ctx, arguments, reading, rules, check_passes, "check_passes", profiles)
    fixes = fix or diff or fix_only

    def new_report() -> CheckReport:
        return CheckReport(style, notes=notes, every=every, baseline=baseline_of(ctx, baseline, update=update_baseline))

    def look(content: str | bytes, name: str) -> LoadResult:
        load_options, _, passes = options.of(name)
        return _check(InputSource(content, name), load_options, passes, reading)

    def check(source: InputSource, report: CheckReport) -> None:
        report.add(look(*source), options.of(source.name).policy)

    def fixing(source: InputSource) -> "Fixing":
        from twinform.cli.fixing import Fixing  # noqa: PLC0415 - see above

        load_options, policy, _ = options.of(source.name)
        return Fixing(look, load_options, policy, unsafe=unsafe_fixes, diff=diff, notes=notes)

    if watch:
        if style != "text" or update_baseline or fixes or "-" in words:
            raise click.UsageError("--watch prints text, of files: leave --format, --update-baseline, --fix and - out")
        from twinform.cli.watching import watch_models  # noqa: PLC0415 - it seldom happens

        ctx.exit(watch_models(lambda: model_inputs(words, exclusion)[0], new_report, check))
    report = new_report()
    if fixes:
        ctx.exit(_fix(sources, fixing, report, diff=diff, silent=diff or fix_only))
    for source in sources:
        check(source, report)
    ctx.exit(report.end())


def _fix(
    sources: "Sequence[InputSource]",
    fixing: "Callable[[InputSource], Fixing]",
    report: CheckReport,
    *,
    diff: bool,
    silent: bool,
) -> int:
    """Fix files, or print what would change; report what is left unless `silent`, and return the exit code."""
    from twinform.cli.fixing import run_fixes  # noqa: PLC0415 - most runs only look

    report.on_stderr = not diff and any(isinstance(each.content, bytes) for each in sources)
    if report.on_stderr and report.style != "text" and not silent:
        raise click.UsageError("the fixed text of standard input is printed: leave --format out, or give --diff")
    loaded, report.fixed = run_fixes(sources, fixing)
    if silent:
        return UNUSABLE if any(each.unreadable for each in loaded) else FINDINGS if diff and report.fixed else 0
    for source, each in zip(sources, loaded, strict=True):
        report.add(each, fixing(source).policy)
    return report.end()


def _check(
    source: InputSource, load_options: LoadOptions, passes: "Pipeline | None", reading: ReadingOptions
) -> LoadResult:
    try:
        return inspect(read_model(source, load_options, reading), load_options, passes)
    except ReadOnlyPassError as error:
        raise click.UsageError(str(error)) from error
    except PassError as error:
        raise Unusable(str(error)) from error
