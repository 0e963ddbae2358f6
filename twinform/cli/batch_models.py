"""The models of a batch: the argument SRC, and the options that choose among them."""

import sys
from collections.abc import Generator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypedDict

import click

from twinform.cli.command import Unusable, combine_options
from twinform.cli.flags import group
from twinform.compiler.batch import PATTERNS, FolderError, ModelEntry, Shard, of_folder, of_names, with_arguments
from twinform.compiler.batch.archives import is_archive, unpacked
from twinform.file_access import Readable


class ModelOptions(TypedDict):
    """Options that choose the models of a batch."""

    patterns: tuple[str, ...]
    names: Path | None
    arguments: Path | None
    shard: Shard | None


@dataclass(frozen=True, slots=True)
class Models:
    """The models of a run and their folder, which messages call `shown` if that is set.

    `contents` has the digests of the files of a folder that was just unpacked.
    """

    folder: Path
    entries: Sequence[ModelEntry]
    shown: str = ""
    contents: Mapping[str, str] = field(default_factory=dict[str, str])


def _parse_shard(_ctx: click.Context, _option: click.Parameter, value: str | None) -> Shard | None:
    if value is None:
        return None
    number, _, count = value.partition("/")
    if not (number.isdecimal() and count.isdecimal() and 1 <= int(number) <= int(count)):
        raise click.BadParameter(f"{value!r} is no part of several, such as 3/16")
    return Shard(int(number), int(count))


_PATH = click.Path(path_type=Path)
_PATTERN = click.option(
    "--pattern",
    "patterns",
    metavar="GLOB",
    multiple=True,
    default=PATTERNS,
    help=f"Which files are models; repeatable. Else {', '.join(PATTERNS)}.",
)
_SHARD = click.option(
    "--shard",
    metavar="N/M",
    callback=_parse_shard,
    help="Only part N of M; its name decides which one a model is in.",
)
_OPTIONS = (
    _PATTERN,
    click.option("--names", type=_PATH, metavar="FILE", help="The models by name, one in a line; - is standard input."),
    click.option(
        "--arguments",
        type=_PATH,
        metavar="FILE",
        help="Arguments of xacro: CSV or JSONL with a column 'model', one for each argument, and perhaps 'name'.",
    ),
    _SHARD,
)


model_options = group("chosen", ModelOptions, *_OPTIONS)
"""Adds the options that choose models to a command."""


pair_options = combine_options(_PATTERN, _SHARD)
"""Adds the options that choose models to a command that compares the models of two folders."""


@contextmanager
def models(source: Path, options: ModelOptions, results: Path | None = None) -> Generator[Models]:
    """Yield the models of SRC: a folder, an archive, or `-` for a list of names on standard input.

    Raises:
        click.UsageError: there is no such folder, or an option does not fit it.
        Unusable: a file cannot be read.
    """
    names = options["names"]
    if str(source) == "-":
        source, names = Path(), Path("-")
    try:
        if is_archive(source):
            with unpacked(source) as made:
                yield Models(made.folder, _find_entries(made.folder, names, options, None), str(source), made.contents)
            return
        yield Models(source, _find_entries(source, names, options, results))
    except FolderError as error:
        raise click.UsageError(str(error)) from error


def _find_entries(folder: Path, names: Path | None, options: ModelOptions, results: Path | None) -> list[ModelEntry]:
    try:
        if names is None:
            found = of_folder(folder, options["patterns"], results)
        else:
            text = sys.stdin.buffer.read() if str(names) == "-" else Readable.of(names).read(names)
            found = of_names(folder, text)
        return with_arguments(found, options["arguments"]) if options["arguments"] else found
    except OSError as error:
        raise Unusable(f"cannot read {error.filename}: {error.strerror}") from error
