"""`twinform batch diff`."""

from pathlib import Path

import click

from twinform.cli.batch.models import pair_options
from twinform.cli.batch.running import RunOptions, run_and_end, run_options
from twinform.cli.command import Command
from twinform.cli.comparison_options import comparison_options
from twinform.cli.inputs import file_options, load_options_of
from twinform.compiler.batch import Batch, Diff, FolderError, Shard, of_folder, pairs
from twinform.compiler.compare import ComparisonOptions
from twinform.compiler.input.load_options import FileOptions

EXAMPLES = {
    "Compare the models of two folders": "twinform batch diff models out",
}


@click.command("diff", cls=Command, examples=EXAMPLES)
@click.argument("a", metavar="A", type=click.Path(path_type=Path))
@click.argument("b", metavar="B", type=click.Path(path_type=Path))
@comparison_options
@pair_options
@run_options
@file_options
@click.pass_context
def command(
    ctx: click.Context,
    a: Path,
    b: Path,
    *,
    patterns: tuple[str, ...],
    shard: Shard | None,
    comparison: ComparisonOptions,
    run: RunOptions,
    reading: FileOptions,
) -> None:
    """Say which models of two folders are the same robots.

    Models are compared that have the same name below A and B, but for the endings of formats: the sources of a
    conversion with its results. --report has what differs. Exit code: 0 all the same, 1 others, or missing ones, 2
    where a file could not be read.
    """
    try:
        entries = pairs(of_folder(a, patterns), of_folder(b, patterns))
    except FolderError as error:
        raise click.UsageError(str(error)) from error
    whole = Batch(
        source=a,
        entries=entries,
        job=Diff(other=b, options=comparison),
        load_options=load_options_of({}, reading),
        shard=shard,
        seconds=run["timeout"],
    )
    run_and_end(ctx, whole, run)
