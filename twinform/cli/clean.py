"""`twinform clean`."""

from pathlib import Path

import click

from twinform.cli.command import Command, Unusable
from twinform.cli.file_runs import cache_folder
from twinform.cli.printing import print_line
from twinform.diagnostics.wording import plural

EXAMPLES = {
    "Delete what is kept of earlier runs": "twinform clean",
    "In a folder that --cache-dir has named": "twinform clean --cache-dir .twinform_cache",
}


@click.command("clean", cls=Command, examples=EXAMPLES)
@click.option(
    "--cache-dir",
    type=click.Path(path_type=Path, file_okay=False),
    metavar="DIR",
    help="The folder of the results; by default in your cache folder.",
)
def command(cache_dir: Path | None) -> None:
    """Delete the results of earlier runs of check and format.

    Nothing else is deleted, and the next run reads all files again.
    """
    folder = cache_folder(cache_dir)
    if folder is None or not folder.is_dir():
        print_line("there are no results of earlier runs", err=True)
        return
    from twinform.compiler.result_cache import delete_results  # noqa: PLC0415 - with it comes the compiler

    try:
        number = delete_results(folder)
    except OSError as error:
        raise Unusable(f"cannot delete {error.filename}: {error.strerror}") from error
    print_line(f"deleted {plural(number, 'file')} in {folder}", err=True)
