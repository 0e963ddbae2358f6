"""`twinform convert --split`: a world into a file for each of its models, and one that includes them."""

from dataclasses import replace
from pathlib import Path

import click

from twinform.cli.conversion import Options, summary
from twinform.cli.failure import FINDINGS, UNUSABLE, Unusable
from twinform.cli.source import Source
from twinform.compiler import CompileError, Split, split, write_all_atomically
from twinform.passes import PassError


def run_split(source: Source, options: Options, folder: Path) -> int:
    """Split one world into a folder; gives the exit code. Nothing is written where one of the files has an error."""
    watched = options.watching.begin(source.name)
    try:
        order = replace(options.order, to="urdf", model=None)
        result = split(order, source.content, options.reading, name=source.name, watch=watched.watch)
    except CompileError as error:
        watched.report()
        options.show(source.name, error.diagnostics)
        return UNUSABLE if error.unreadable else FINDINGS
    except PassError as error:
        watched.fault(error)
        return FINDINGS
    watched.end()
    if not options.show(source.name, result.diagnostics):
        return FINDINGS
    _write(result, folder, options.ledger)
    click.echo(f"{len(result.files)} files: {summary(result.ledger)}", err=True)
    return 0


def _write(result: Split, folder: Path, ledger: Path | None) -> None:
    texts = {folder / name: text for name, text in result.files.items()}
    if ledger is not None:
        texts[ledger] = result.ledger.to_json()
    try:
        write_all_atomically(texts)
    except OSError as error:
        raise Unusable(f"cannot write {error.filename or folder}: {error.strerror}") from error
