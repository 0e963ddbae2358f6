"""`twinform batch convert`."""

from pathlib import Path
from typing import Literal

import click

from twinform.cli.batch.models import ModelOptions, model_options, models
from twinform.cli.batch.running import RunOptions, run_and_end, run_options
from twinform.cli.command import Command
from twinform.cli.config.per_file import RuleSettings
from twinform.cli.consumer_option import consumers_option, keep_physics_option
from twinform.cli.inputs import load_options_of, reading_options
from twinform.cli.policy import policy_of, policy_options
from twinform.cli.request import request_options, whole_request
from twinform.compiler import ConversionRequest
from twinform.compiler.batch import Batch, Convert
from twinform.compiler.input.load_options import ReadingOptions
from twinform.compiler.request_options import RequestOptions
from twinform.profiles import Profile

EXAMPLES = {
    "Convert a folder of models, with four processes": "twinform batch convert models out --to sdf --jobs 4",
    "Bring model.config and meshes along": "twinform batch convert models out --to sdf --model-folders",
    "A quarter of them, on each of four machines": "twinform batch convert models out --to sdf --shard 1/4",
}


@click.command("convert", cls=Command, examples=EXAMPLES)
@click.argument("source", metavar="SRC", type=click.Path(path_type=Path))
@click.argument("dest", metavar="DEST", type=click.Path(path_type=Path))
@click.option("--to", "target", type=click.Choice(["sdf", "urdf"]), required=True, help="The format.")
@consumers_option
@keep_physics_option
@request_options
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
def command(
    ctx: click.Context,
    source: Path,
    dest: Path,
    target: Literal["sdf", "urdf"],
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
    rules: RuleSettings,
    reading: ReadingOptions,
) -> None:
    """Compile every model of a folder.

    SRC is a folder, a tar or zip archive, or - for a list of names on standard input. The results go into DEST, at the
    same place below it. What was done is not done again, as long as what is asked for, all files that a model was made
    from, and its result are what they were. Exit code: 0 without errors, 1 with errors, 2 where a file could not be
    read or written, 130 after Ctrl-C.
    """
    if target != "sdf":
        request["sdf_version"] = None
    policy = policy_of(ctx, rules)
    wanted = ConversionRequest.of(target, whole_request(request, reading, keep_physics=keep_physics))
    job = Convert(to=wanted, policy=policy, split=split, ledgers=ledgers, model_folders=model_folders)
    with models(source, chosen, dest) as found:
        whole = Batch(
            source=found.folder,
            entries=found.entries,
            job=job,
            load_options=load_options_of({}, reading, policy, profiles),
            dest=dest,
            shard=chosen["shard"],
            seconds=run["timeout"],
            fresh=fresh,
            report=run["report"],
            shown=found.shown,
            contents=found.contents,
        )
        run_and_end(ctx, whole, run)
