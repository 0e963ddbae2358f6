"""`twinform convert`."""

from pathlib import Path
from typing import Unpack

import click

from twinform.cli.conversion import Options, print_plan, run_conversion
from twinform.cli.failure import Unusable
from twinform.cli.findings import notes_option
from twinform.cli.inputs import HowToRead, how_to_read, inputs, reading_options
from twinform.cli.source import Source
from twinform.cli.splitting import run_split
from twinform.cli.targets import TARGETS, Target, jobs
from twinform.compiler import Order, UrdfVersion
from twinform.passes import Pipeline, PipelineError, RegistryError, parse_pipeline
from twinform.schemas import table


def _known_version(_ctx: click.Context, _option: click.Parameter, value: str | None) -> str | None:
    versions = table("sdf").versions
    if value is not None and value not in versions:
        raise click.BadParameter(f"SDF has no version {value!r}; it has {', '.join(versions)}")
    return value


def _pipeline(_ctx: click.Context, _option: click.Parameter, value: str | None) -> Pipeline:
    try:
        return parse_pipeline(value or "")
    except PipelineError as error:
        raise click.BadParameter(str(error)) from error
    except RegistryError as error:
        raise Unusable(str(error)) from error


@click.command("convert")
@click.argument("words", metavar="IN... [NAME:=VALUE...]", nargs=-1, required=True)
@click.option("-o", "--output", "out", metavar="OUT", help="The file to write, or the directory for several inputs.")
@click.option("--to", "target", type=click.Choice(TARGETS), help="The format; else OUT's suffix or the other format.")
@click.option("--sdf-version", metavar="V", callback=_known_version, help="The version of SDF to write.")
@click.option("--urdf-version", type=click.Choice(["1.0", "1.1", "1.2"]), default="1.0", help="Likewise of URDF.")
@click.option("--passes", metavar="PIPELINE", callback=_pipeline, help="Passes to run, such as 'check-inertia'.")
@click.option(
    "--ledger", type=click.Path(path_type=Path), metavar="FILE", help="Where to write what was not expressed."
)
@click.option("--carriers/--no-carriers", default=True, help="Whether to keep in our namespace what the target lacks.")
@click.option("--model", metavar="NAME", help="The model of a world to convert.")
@notes_option
@click.option(
    "--split",
    is_flag=True,
    help="Write each model of a world as URDF into the directory OUT, and an SDF that includes them.",
)
@click.option("--audit", is_flag=True, help="Count what became of every element and attribute; fail if any is missing.")
@reading_options
@click.option("--print-pipeline", is_flag=True, help="Print every pass that would run, in order, and stop.")
@click.option("--dump-ir-after", "dumps", metavar="PASS", multiple=True, help="Print the IR after a pass on stderr.")
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    out: str | None,
    target: Target | None,
    *,
    sdf_version: str | None,
    urdf_version: UrdfVersion,
    passes: Pipeline,
    ledger: Path | None,
    carriers: bool,
    model: str | None,
    split: bool,
    audit: bool,
    print_pipeline: bool,
    dumps: tuple[str, ...],
    notes: bool,
    expand_includes: bool,
    **how: Unpack[HowToRead],
) -> None:
    """Compile robot models from one format into the other.

    IN are URDF, SDF, xacro or JSON files; - is standard input. Arguments of xacro are written NAME:=VALUE. Nothing is
    written for an input that has an error. Exit code: 0 without errors, 1 with errors, 2 where a file could not be read
    or written.
    """
    sources, arguments = inputs(words)
    if ledger is not None and len(sources) > 1:
        raise click.UsageError("--ledger takes one input")
    order = Order(
        to="sdf",
        sdf_version=sdf_version,
        urdf_version=urdf_version,
        passes=passes,
        carriers=carriers,
        model=model,
        expand_includes=expand_includes,
    )
    reading = how_to_read(arguments, **how)
    if ledger is not None and out is not None and Path(out).resolve() == ledger.resolve():
        raise click.UsageError("--ledger and -o name the same file")
    options = Options(order=order, reading=reading, ledger=ledger, dumps=dumps, notes=notes, audit=audit)
    if split:
        ctx.exit(run_split(_only(sources), options, _folder(out, target, model)))
    todo = jobs(sources, out, target)
    if sdf_version is not None and all(job.target != "sdf" for job in todo):
        raise click.UsageError("--sdf-version is for --to sdf")
    run = print_plan if print_pipeline else run_conversion
    ctx.exit(max(run(job, options, label=job.source.name if len(todo) > 1 else "") for job in todo))


def _only(sources: list[Source]) -> Source:
    if len(sources) > 1:
        raise click.UsageError("--split takes one input")
    return sources[0]


def _folder(out: str | None, target: Target | None, model: str | None) -> Path:
    """The directory that a world is split into."""
    if out is None or out == "-" or (Path(out).exists() and not Path(out).is_dir()):
        raise click.UsageError("--split needs -o DIRECTORY")
    if target not in {None, "urdf"} or model is not None:
        raise click.UsageError("--split makes URDF of every model; leave --to and --model out")
    return Path(out)
