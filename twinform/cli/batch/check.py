"""`twinform batch check`."""

from pathlib import Path

import click

from twinform.cli.batch.models import ModelOptions, model_options, models
from twinform.cli.batch.running import RunOptions, run_and_end, run_options
from twinform.cli.command import Command
from twinform.cli.completion import pipelines
from twinform.cli.config.per_file import RuleSettings
from twinform.cli.consumer_option import consumers_option
from twinform.cli.inputs import load_options_of, reading_options
from twinform.cli.policy import policy_of, policy_options
from twinform.cli.request import pipeline_option
from twinform.compiler.batch import Batch, Check
from twinform.compiler.input.load_options import ReadingOptions
from twinform.passes import Pipeline
from twinform.profiles import Profile

EXAMPLES = {
    "Check a folder of models": "twinform batch check models --report findings.jsonl",
}


@click.command("check", cls=Command, examples=EXAMPLES)
@click.argument("source", metavar="SRC", type=click.Path(path_type=Path))
@click.option(
    "--passes",
    "check_passes",
    metavar="PIPELINE",
    callback=pipeline_option("check-passes"),
    shell_complete=pipelines,
    help="Passes that only look, such as 'check-inertia,check-limits', or @NAME for one that the configuration names.",
)
@consumers_option
@model_options
@run_options
@policy_options
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    source: Path,
    *,
    check_passes: Pipeline,
    profiles: tuple[Profile, ...],
    chosen: ModelOptions,
    run: RunOptions,
    rules: RuleSettings,
    reading: ReadingOptions,
) -> None:
    """Find everything that is wrong with the models of a folder.

    SRC is a folder, a tar or zip archive, or - for a list of names on standard input. Models with errors are named;
    --report has all findings. Exit code: 0 without errors, 1 with errors, 2 where a file could not be read.
    """
    policy = policy_of(ctx, rules)
    job = Check(policy=policy, passes=check_passes, expand_includes=reading.get("expand_includes") or False)
    with models(source, chosen) as found:
        whole = Batch(
            source=found.folder,
            entries=found.entries,
            job=job,
            load_options=load_options_of({}, reading, policy, profiles),
            shard=chosen["shard"],
            seconds=run["timeout"],
            shown=found.shown,
        )
        run_and_end(ctx, whole, run)
