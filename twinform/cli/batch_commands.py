"""The commands of `twinform batch`, and the options that choose among the models of SRC."""

import sys
from collections.abc import Generator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import field
from pathlib import Path
from typing import Literal, NoReturn, TypedDict

import click

from twinform.cli.batch_run import RunOptions, run_and_end, run_options
from twinform.cli.command import Command, Unusable, combine_options
from twinform.cli.completion import pipelines
from twinform.cli.diff import comparison_options
from twinform.cli.flags import group
from twinform.cli.inputs import file_options, load_options_of, reading_options
from twinform.cli.printing import print_line
from twinform.cli.project_options import (
    consumers_option,
    keep_physics_option,
    pipeline_option,
    request_options_of_many,
    whole_request,
)
from twinform.cli.rule_options import policy_of, policy_options
from twinform.compiler import ConversionRequest, LoadOptions
from twinform.compiler.batch import (
    PATTERNS,
    Batch,
    BusyError,
    Check,
    Convert,
    Diff,
    FolderError,
    ModelEntry,
    Shard,
    Stats,
    merge,
    of_folder,
    of_names,
    pairs,
    with_arguments,
)
from twinform.compiler.batch.archives import is_archive, unpacked
from twinform.compiler.batch.task import BatchJob
from twinform.compiler.compare import ComparisonOptions
from twinform.compiler.input.load_options import FileOptions, ReadingOptions
from twinform.dataclass import dataclass
from twinform.diagnostics.wording import plural
from twinform.file_access import Readable
from twinform.passes import Pipeline
from twinform.profiles import Profile
from twinform.request_options import RequestOptions


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
    help=f"Which files are models; repeatable. Else {', '.join(PATTERNS)}, and *.xml with the root <mujoco>.",
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


commands = click.Group("batch")


@commands.command(
    cls=Command,
    examples={
        "Convert a folder of models, with four processes": "twinform batch convert models out --to sdf --jobs 4",
        "Bring model.config and meshes along": "twinform batch convert models out --to sdf --model-folders",
        "A quarter of them, on each of four machines": "twinform batch convert models out --to sdf --shard 1/4",
    },
)
@click.argument("source", metavar="SRC", type=_PATH)
@click.argument("dest", metavar="DEST", type=_PATH)
@click.option("--to", "target", type=click.Choice(["sdf", "urdf", "mjcf"]), required=True, help="The format.")
@consumers_option
@keep_physics_option
@request_options_of_many
@click.option(
    "--split", is_flag=True, help="Write each world into a folder: its models, and an SDF that includes them."
)
@click.option(
    "--model-folders",
    is_flag=True,
    help="Bring along what lies beside a model that a model.config names: that file, meshes, textures.",
)
@click.option("--ledgers", is_flag=True, help="Write beside each result what was not expressed.")
@click.option("--fresh", is_flag=True, help="Work on every model again, also where nothing has changed.")
@model_options
@run_options
@policy_options
@reading_options
@click.pass_context
def convert(
    ctx: click.Context,
    source: Path,
    dest: Path,
    target: Literal["sdf", "urdf", "mjcf"],
    *,
    profiles: tuple[Profile, ...],
    keep_physics: bool,
    split: bool,
    model_folders: bool,
    ledgers: bool,
    fresh: bool,
    request: RequestOptions,
    chosen: ModelOptions,
    run: RunOptions,
    reading: ReadingOptions,
    **_options: object,
) -> None:
    """Compile every model of a folder.

    SRC is a folder, a tar or zip archive, or - for a list of names on standard input. The results go into DEST, at the
    same place below it. What was done is not done again, as long as what is asked for, all files that a model was made
    from, and its result are what they were. Exit code: 0 without errors, 1 with errors, 2 where a file could not be
    read or written, 130 after Ctrl-C.
    """
    if split and target == "mjcf":
        raise click.UsageError("--split makes a file of every model, URDF or SDF")
    if target != "sdf":
        request["sdf_version"] = None
    policy = policy_of(ctx)
    wanted = ConversionRequest.of(target, whole_request(request, reading, keep_physics=keep_physics))
    job = Convert(to=wanted, policy=policy, split=split, ledgers=ledgers, model_folders=model_folders)
    load_options = load_options_of({}, reading, policy, profiles)
    _run_on_models(ctx, source, chosen, run, job, load_options, dest, fresh=fresh)


@commands.command(
    cls=Command, examples={"Check a folder of models": "twinform batch check models --report findings.jsonl"}
)
@click.argument("source", metavar="SRC", type=_PATH)
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
def check(
    ctx: click.Context,
    source: Path,
    *,
    check_passes: Pipeline,
    profiles: tuple[Profile, ...],
    chosen: ModelOptions,
    run: RunOptions,
    reading: ReadingOptions,
    **_options: object,
) -> None:
    """Find everything that is wrong with the models of a folder.

    SRC is a folder, a tar or zip archive, or - for a list of names on standard input. Models with errors are named;
    --report has all findings. Exit code: 0 without errors, 1 with errors, 2 where a file could not be read.
    """
    policy = policy_of(ctx)
    job = Check(policy=policy, passes=check_passes, expand_includes=reading.get("expand_includes") or False)
    _run_on_models(ctx, source, chosen, run, job, load_options_of({}, reading, policy, profiles))


@commands.command(cls=Command, examples={"Compare the models of two folders": "twinform batch diff models out"})
@click.argument("a", metavar="A", type=_PATH)
@click.argument("b", metavar="B", type=_PATH)
@comparison_options
@pair_options
@run_options
@file_options
@click.pass_context
def diff(
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
    job, load_options = Diff(other=b, options=comparison), load_options_of({}, reading)
    asked = Batch(source=a, entries=entries, job=job, load_options=load_options, shard=shard, seconds=run["timeout"])
    run_and_end(ctx, asked, run)


@commands.command(cls=Command, examples={"Numbers of every model, for a table": "twinform batch stats models"})
@click.argument("source", metavar="SRC", type=_PATH)
@click.option("--meshes/--no-meshes", default=True, help="Whether to look into mesh files.")
@model_options
@run_options
@reading_options
@click.pass_context
def stats(
    ctx: click.Context, source: Path, *, meshes: bool, chosen: ModelOptions, run: RunOptions, reading: ReadingOptions
) -> None:
    """Say in numbers what the models of a folder are made of.

    Prints a line of JSON for each model, or writes it to --report. SRC is a folder, a tar or zip archive, or - for a
    list of names on standard input. Exit code: 0 without errors, 1 with errors, 2 where a file could not be read.
    """
    run["report"] = run["report"] or Path("-")
    job = Stats(meshes=meshes, expand_includes=reading.get("expand_includes") or False)
    _run_on_models(ctx, source, chosen, run, job, load_options_of({}, reading))


@commands.command(
    "merge", cls=Command, examples={"Put four parts together": "twinform batch merge all out1 out2 out3 out4"}
)
@click.argument("dest", metavar="DEST", type=_PATH)
@click.argument("others", metavar="FROM...", nargs=-1, type=_PATH)
def merge_results(dest: Path, others: tuple[Path, ...]) -> None:
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
    print_line(f"{plural(number, 'model')} in {dest}", err=True)


def _run_on_models(
    ctx: click.Context,
    source: Path,
    chosen: ModelOptions,
    run: RunOptions,
    job: BatchJob,
    load_options: LoadOptions,
    dest: Path | None = None,
    *,
    fresh: bool = False,
) -> NoReturn:
    with models(source, chosen, dest) as found:
        asked = Batch(
            source=found.folder,
            entries=found.entries,
            job=job,
            load_options=load_options,
            dest=dest,
            shard=chosen["shard"],
            seconds=run["timeout"],
            fresh=fresh,
            report=run["report"],
            shown=found.shown,
            contents=found.contents,
        )
        run_and_end(ctx, asked, run)
