"""`twinform batch`."""

from collections.abc import Iterator
from pathlib import Path
from typing import Literal, Unpack

import click

from twinform.cli.failure import Unusable
from twinform.cli.inputs import load_options_of, reading_options
from twinform.cli.policy import policy_of, policy_options
from twinform.cli.request import Asked, ordering_options, request_of
from twinform.compiler import write_atomically
from twinform.compiler.batch import PATTERNS, Batch, FolderError, Outcome, Record, batch, report, summary


@click.command("batch")
@click.argument("source", metavar="SRC", type=click.Path(path_type=Path))
@click.argument("dest", metavar="DEST", type=click.Path(path_type=Path))
@click.option("--to", "target", type=click.Choice(["sdf", "urdf"]), required=True, help="The format.")
@ordering_options
@click.option(
    "--jobs", type=click.IntRange(min=1), metavar="N", help="How many at a time; else one for each processor."
)
@click.option(
    "--timeout",
    type=click.FloatRange(min=0, min_open=True),
    metavar="SECONDS",
    default=60.0,
    show_default=True,
    help="The time limit for one model.",
)
@click.option(
    "--pattern",
    "patterns",
    metavar="GLOB",
    multiple=True,
    default=PATTERNS,
    help=f"Which files are models; repeatable. Else {', '.join(PATTERNS)}.",
)
@click.option("--fresh", is_flag=True, help="Work on every model again, also where nothing has changed.")
@click.option("--ledgers", is_flag=True, help="Write beside each result what was not expressed.")
@click.option("--report", "report_file", type=click.Path(path_type=Path), metavar="FILE", help="A report as JSON.")
@policy_options
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    source: Path,
    dest: Path,
    target: Literal["sdf", "urdf"],
    *,
    jobs: int | None,
    timeout: float,
    patterns: tuple[str, ...],
    fresh: bool,
    ledgers: bool,
    report_file: Path | None,
    allow: tuple[str, ...],
    deny: tuple[str, ...],
    **asked: Unpack[Asked],
) -> None:
    """Compile every model of a folder.

    The models below the folder SRC go into DEST, at the same place below it. Each is worked on in a process of its own,
    so one that crashes or hangs stops no other. What was done is not done again, as long as model, order and result are
    what they were. Exit code: 0 without errors, 1 with errors, 2 where a file could not be read or written.
    """
    asked["sdf_version"] = asked["sdf_version"] if target == "sdf" else None
    whole = Batch(
        source=source,
        dest=dest,
        request=request_of(asked, target),
        load_options=load_options_of({}, asked),
        policy=policy_of(ctx, allow, deny),
        patterns=patterns,
        jobs=jobs,
        seconds=timeout,
        fresh=fresh,
        ledgers=ledgers,
        report=report_file,
    )
    try:
        found = list(_shown(batch(whole)))
    except FolderError as error:
        raise click.UsageError(str(error)) from error
    except OSError as error:
        raise Unusable(f"cannot write {error.filename or dest}: {error.strerror}") from error
    records = [record for record, _ in found]
    _write(report_file, records, target)
    click.echo(summary(records, sum(known for _, known in found)), err=True)
    ctx.exit(max((record.outcome.exit_code for record in records), default=0))


def _shown(found: Iterator[tuple[Record, bool]]) -> Iterator[tuple[Record, bool]]:
    """The same, each model that has no result with its reason on stderr as soon as it is known."""
    for record, known in found:
        if record.outcome is not Outcome.CONVERTED:
            name = click.format_filename(record.source)
            click.echo(f"{name}: {record.outcome}: {click.format_filename(record.message)}", err=True)
        yield record, known


def _write(file: Path | None, records: list[Record], target: str) -> None:
    if file is None:
        return
    try:
        write_atomically(file, report(records, target))
    except OSError as error:
        raise Unusable(f"cannot write {error.filename or file}: {error.strerror}") from error
