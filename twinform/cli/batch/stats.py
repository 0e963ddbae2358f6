"""`twinform batch stats`."""

from pathlib import Path

import click

from twinform.cli.batch.models import ModelOptions, model_options, models
from twinform.cli.batch.running import RunOptions, run_and_end, run_options
from twinform.cli.command import Command
from twinform.cli.inputs import load_options_of, reading_options
from twinform.compiler.batch import Batch, Stats
from twinform.compiler.input.load_options import ReadingOptions

EXAMPLES = {
    "Numbers of every model, for a table": "twinform batch stats models",
}


@click.command("stats", cls=Command, examples=EXAMPLES)
@click.argument("source", metavar="SRC", type=click.Path(path_type=Path))
@click.option("--meshes/--no-meshes", default=True, help="Whether to look into mesh files.")
@model_options
@run_options
@reading_options
@click.pass_context
def command(
    ctx: click.Context, source: Path, *, meshes: bool, chosen: ModelOptions, run: RunOptions, reading: ReadingOptions
) -> None:
    """Say in numbers what the models of a folder are made of.

    Prints a line of JSON for each model, or writes it to --report. SRC is a folder, a tar or zip archive, or - for a
    list of names on standard input. Exit code: 0 without errors, 1 with errors, 2 where a file could not be read.
    """
    run["report"] = run["report"] or Path("-")
    with models(source, chosen) as found:
        whole = Batch(
            source=found.folder,
            entries=found.entries,
            job=Stats(meshes=meshes, expand_includes=reading.get("expand_includes") or False),
            load_options=load_options_of({}, reading),
            shard=chosen["shard"],
            seconds=run["timeout"],
            shown=found.shown,
        )
        run_and_end(ctx, whole, run)
