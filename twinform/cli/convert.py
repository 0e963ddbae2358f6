"""`twinform convert`."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

import click
from click.core import ParameterSource

from twinform.cli.command import Command
from twinform.cli.completion import files
from twinform.cli.config import settings_of
from twinform.cli.consumers import consumers_option, keep_physics_option
from twinform.cli.conversion import Options, print_plan, run_job
from twinform.cli.findings import all_option, notes_option
from twinform.cli.gazebo_files import GazeboFiles, companion_options, version_for
from twinform.cli.inputs import inputs, reading_options
from twinform.cli.instrumentation import InstrumentationOptions, watching_options
from twinform.cli.outputs import Outputs
from twinform.cli.own_options import OptionsByFile
from twinform.cli.policy import policy_options
from twinform.cli.printing import print_line
from twinform.cli.request import Asked, ordering_options, request_of
from twinform.cli.source import Source
from twinform.cli.targets import TARGETS, Job, Target, jobs, jobs_in_place
from twinform.compiler import LoadOptions

if TYPE_CHECKING:
    from twinform.profiles import Profile

EXAMPLES = {
    "Make SDF for Gazebo": "twinform convert robot.urdf -o robot.sdf",
    "Write an older version": "twinform convert robot.urdf -o robot.sdf --sdf-version 1.9",
    "List what was not expressed": "twinform convert robot.sdf -o robot.urdf --ledger ledger.json",
    "Run passes on the way": "twinform convert robot.urdf -o robot.sdf --passes 'fill-limits{effort=100}'",
    "Make what Drake and MuJoCo take": "twinform convert robot.sdf -o robot.urdf --for drake,mujoco",
    "Change a file itself, where a pass does": "twinform convert robot.urdf --in-place --passes fill-inertia",
    "Let a URDF follow what was edited in its SDF": "twinform convert robot.sdf --into robot.urdf",
}


@click.command("convert", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="IN... [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@click.option(
    "-o",
    "--output",
    "out",
    metavar="OUT",
    shell_complete=files,
    help="The file to write, or the directory for several inputs.",
)
@click.option("--in-place", is_flag=True, help="Change each input itself, and in it only what the passes change.")
@click.option(
    "--into",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Change this file of the other format, and in it only what has changed in IN since it was made of it.",
)
@click.option(
    "--base", type=click.Path(path_type=Path), metavar="FILE", help="With --into: IN as it was before it was changed."
)
@consumers_option
@keep_physics_option
@click.option("--to", "target", type=click.Choice(TARGETS), help="The format; else OUT's suffix or the other format.")
@ordering_options
@click.option(
    "--ledger", type=click.Path(path_type=Path), metavar="FILE", help="Where to write what was not expressed."
)
@companion_options
@click.option("--model", metavar="NAME", help="The model of the file to convert, whatever it becomes.")
@notes_option
@all_option
@policy_options
@click.option(
    "--split",
    is_flag=True,
    help="Write each model of a world into the directory OUT, and an SDF that includes them: URDF where Gazebo reads "
    "it as the same robot, or SDF with --to sdf.",
)
@click.option(
    "--check", is_flag=True, help="Write nothing: print how the files that are there differ from what would be written."
)
@click.option("--audit", is_flag=True, help="Count what became of every element and attribute; fail if any is missing.")
@reading_options
@click.option("--print-pipeline", is_flag=True, help="Print every pass that would run, in order, and stop.")
@watching_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    out: str | None,
    target: Target | None,
    *,
    profiles: "tuple[Profile, ...]",
    keep_physics: bool,
    ledger: Path | None,
    bridge: Path | None,
    world: Path | None,
    gazebo: str,
    model: str | None,
    split: bool,
    audit: bool,
    check: bool,
    print_pipeline: bool,
    dumps: tuple[str, ...],
    changes: bool,
    times: bool,
    statistics: bool,
    reproducers: Path | None,
    in_place: bool,
    into: Path | None,
    base: Path | None,
    notes: bool,
    every: bool,
    allow: tuple[str, ...],
    deny: tuple[str, ...],
    **asked: Unpack[Asked],
) -> None:
    """Compile robot models from one format into the other.

    IN are URDF, SDF, xacro or JSON files; - is standard input. Arguments of xacro are written NAME:=VALUE. All that is
    asked for is written at once, or, where an input has an error, nothing. No file is written over one that is read.
    Exit code: 0 without errors, 1 with errors or where --check finds a difference, 2 where a file could not be read or
    written.
    """
    sources, arguments = inputs(words)
    if ledger is not None and len(sources) > 1:
        raise click.UsageError("--ledger takes one input")
    if ctx.get_parameter_source("gazebo") is not ParameterSource.DEFAULT:
        asked["sdf_version"] = version_for(gazebo, asked["sdf_version"])
    by_file = OptionsByFile(ctx, arguments, asked, allow, deny, asked["passes"], profiles=profiles)
    load_options, policy, _ = by_file.usual
    watching = InstrumentationOptions(
        dumps=dumps, changes=changes, times=times, statistics=statistics, reproducers=reproducers
    )
    options = Options(
        request=replace(request_of(asked, "sdf", model), keep_physics=keep_physics),
        load_options=load_options,
        ledger=ledger,
        notes=notes,
        every=every,
        policy=policy,
        watching=watching,
        audit=audit,
        gazebo_files=GazeboFiles(bridge, world, gazebo),
    )
    if len(sources) == 1:
        options = options.for_file(by_file.of(sources[0].name))
    if options.gazebo_files and (split or len(sources) > 1):
        raise click.UsageError("--bridge and --world take one input, and no --split")
    if options.beside and len(sources) > 1:
        raise click.UsageError(f"a pass writes {options.beside[0]} beside the result; that takes one input")
    read = [source.path for source in sources] + [path for path in [settings_of(ctx).path] if path]
    _require_consumers(profiles, alone=not (split or into), keep_physics=keep_physics)
    if split:
        from twinform.cli.splitting import run_split  # noqa: PLC0415 - few worlds are split

        whole = Outputs(read, check=check)
        folder = _folder(out, target, model, in_place=in_place)
        code = run_split(_only(sources), target or "urdf", options, folder, whole)
        ctx.exit(_end(whole, [code], load_options))
    if into or base:
        from twinform.cli.into import run_into  # noqa: PLC0415 - most results are new files

        if out or in_place or target or asked["passes"]:
            raise click.UsageError("--into says what is written: leave -o, --in-place, --to and --passes out")
        updated = Outputs(read, [into] if into else (), check)
        code = run_into(_only(sources, "--into"), into, base, options, updated)
        ctx.exit(_end(updated, [code], load_options))
    todo = jobs_in_place(sources, out, target) if in_place else jobs(sources, out, target)
    _require_sdf(ctx, todo)
    planned = [(job, options.for_file(by_file.of(job.source.name))) for job in todo]
    if print_pipeline:
        ctx.exit(max(print_plan(job, own, label=_label(job, todo)) for job, own in planned))
    outputs = Outputs(read, [job.path for job in todo if in_place and job.path], check)
    outputs.require_apart([place for job, own in planned for place in own.places(job, outputs)])
    ctx.exit(_end(outputs, [run_job(job, own, _label(job, todo), outputs) for job, own in planned], load_options))


def _require_consumers(profiles: "tuple[Profile, ...]", *, alone: bool, keep_physics: bool) -> None:
    """Raise where options contradict --for, or need it."""
    if keep_physics and not profiles:
        raise click.UsageError("--keep-physics is for --for")
    if not alone and any(each.named for each in profiles):
        raise click.UsageError("--for takes neither --split nor --into")


def _require_sdf(ctx: click.Context, todo: Sequence[Job]) -> None:
    """Raise where a version of SDF is typed, and nothing becomes SDF."""
    versioned = ctx.get_parameter_source("sdf_version") is ParameterSource.COMMANDLINE
    if versioned and all(job.target != "sdf" for job in todo):
        raise click.UsageError("--sdf-version is for --to sdf")


def _label(job: Job, todo: Sequence[Job]) -> str:
    """What is printed before the news of a job, where there are several."""
    return job.source.name if len(todo) > 1 else ""


def _end(outputs: Outputs, codes: Sequence[int], load_options: LoadOptions) -> int:
    """Write everything if nothing is wrong; gives the exit code."""
    if not max(codes):
        return outputs.write(load_options.search.seen)
    if len(codes) > 1:
        wrong = sum(map(bool, codes))
        print_line(f"nothing is written: {wrong} of {len(codes)} inputs could not be converted", err=True)
    return max(codes)


def _only(sources: list[Source], option: str = "--split") -> Source:
    if len(sources) > 1:
        raise click.UsageError(f"{option} takes one input")
    return sources[0]


def _folder(out: str | None, target: Target | None, model: str | None, *, in_place: bool) -> Path:
    """The directory that a world is split into."""
    if in_place or out is None or out == "-" or (Path(out).exists() and not Path(out).is_dir()):
        raise click.UsageError("--split needs -o DIRECTORY")
    if target == "json" or model is not None:
        raise click.UsageError("--split makes a file of every model, URDF or SDF; leave --model out")
    return Path(out)
