"""`twinform batch merge`."""

from pathlib import Path

import click

from twinform.cli.command import Command
from twinform.cli.failure import Unusable
from twinform.cli.printing import print_line
from twinform.compiler.batch import BusyError, merge

EXAMPLES = {
    "Put four parts together": "twinform batch merge all out1 out2 out3 out4",
}


@click.command("merge", cls=Command, examples=EXAMPLES)
@click.argument("dest", metavar="DEST", type=click.Path(path_type=Path))
@click.argument("others", metavar="FROM...", nargs=-1, type=click.Path(path_type=Path))
def command(dest: Path, others: tuple[Path, ...]) -> None:
    """Put the results of several runs together.

    Takes over the results of the folders FROM, as far as they match their manifests, and makes one manifest of
    those that the shards of DEST have written.
    """
    try:
        number = merge(dest, list(others))
    except BusyError as error:
        raise click.UsageError(str(error)) from error
    except OSError as error:
        raise Unusable(f"cannot merge {error.filename or dest}: {error.strerror or error}") from error
    print_line(f"{number} model{'' if number == 1 else 's'} in {dest}", err=True)
