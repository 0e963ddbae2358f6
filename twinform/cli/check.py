"""`twinform check`."""

from pathlib import Path
from typing import TYPE_CHECKING, Unpack

import click
import pydantic  # noqa: F401 # pyright: ignore[reportUnusedImport] - decisions: near the top of the stack

from twinform.cli.baseline import baseline_of, baseline_options
from twinform.cli.check_report import CheckReport
from twinform.cli.command import Command
from twinform.cli.completion import files, pipelines
from twinform.cli.exclude import exclude_options, exclusion_of
from twinform.cli.failure import Unusable
from twinform.cli.findings import all_option, notes_option
from twinform.cli.inputs import InputOptions, model_inputs, reading_options
from twinform.cli.own_options import OptionsByFile
from twinform.cli.pipeline_option import pipeline_option
from twinform.cli.policy import policy_options
from twinform.cli.source import Source
from twinform.compiler import LoadOptions, LoadResult, ReadOnlyPassError, inspect, read
from twinform.diagnostics.reporters import REPORTERS
from twinform.passes import PassError

if TYPE_CHECKING:
    from twinform.passes import Pipeline


EXAMPLES = {
    "Find mistakes": "twinform check robot.urdf",
    "Also what is legal and yet worth knowing, for a program": "twinform check robot.sdf --notes --format json",
    "Expand a xacro file with an argument of its own": "twinform check arm.urdf.xacro prefix:=left_",
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
@exclude_options
@click.option("--watch", is_flag=True, help="Stay, and check what changes again, until Ctrl-C.")
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    style: str,
    *,
    notes: bool,
    every: bool,
    allow: tuple[str, ...],
    deny: tuple[str, ...],
    baseline: Path | None,
    update_baseline: bool,
    check_passes: "Pipeline | None",
    exclude: tuple[str, ...],
    force_exclude: bool,
    watch: bool,
    expand_includes: bool,
    **input_options: Unpack[InputOptions],
) -> None:
    """Find everything that is wrong with robot models.

    IN are URDF, SDF, xacro or JSON files, folders of them, or globs in quotes; - is standard input. Arguments of xacro
    are written NAME:=VALUE. Exit code: 0 without errors, 1 with errors, 2 where a file could not be read.
    """
    exclusion = exclusion_of(ctx, exclude, force=force_exclude)
    sources, arguments = model_inputs(words, exclusion)
    options = OptionsByFile(ctx, arguments, input_options, allow, deny, check_passes, "check_passes")

    def new_report() -> CheckReport:
        return CheckReport(style, notes=notes, every=every, baseline=baseline_of(ctx, baseline, update=update_baseline))

    def check(source: Source, report: CheckReport) -> None:
        load_options, policy, passes = options.of(source.name)
        report.add(_checked(source, load_options, passes, expand_includes=expand_includes), policy)

    if watch:
        if style != "text" or update_baseline or "-" in words:
            raise click.UsageError("--watch prints text, of files: leave --format, --update-baseline and - out")
        from twinform.cli.watching import watch_models  # noqa: PLC0415 - it seldom happens

        ctx.exit(watch_models(lambda: model_inputs(words, exclusion)[0], new_report, check))
    report = new_report()
    for source in sources:
        check(source, report)
    ctx.exit(report.end())


def _checked(
    source: Source, load_options: LoadOptions, passes: "Pipeline | None", *, expand_includes: bool
) -> LoadResult:
    loaded = read(source.content, load_options, name=source.name)
    if expand_includes:
        from twinform.compiler import expand  # noqa: PLC0415 - few runs read other files

        loaded = expand(loaded, load_options)
    try:
        return inspect(loaded, load_options, passes)
    except ReadOnlyPassError as error:
        raise click.UsageError(str(error)) from error
    except PassError as error:
        raise Unusable(str(error)) from error
