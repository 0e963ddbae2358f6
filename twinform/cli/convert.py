"""`twinform convert`."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.core import ParameterSource

from twinform.cli.command import Command
from twinform.cli.completion import files
from twinform.cli.config_defaults import settings_of
from twinform.cli.followed import describe_followed, followed_files
from twinform.cli.gazebo_files import GazeboFiles, companion_options, version_for
from twinform.cli.inputs import InputSource, inputs, reading_options
from twinform.cli.instrumentation import InstrumentationOptions, watching_options
from twinform.cli.outputs import Outputs
from twinform.cli.printing import all_option, notes_option, print_line
from twinform.cli.project_options import (
    OptionsByFile,
    consumers_option,
    keep_physics_option,
    request_options,
    whole_request,
)
from twinform.cli.rule_options import policy_options
from twinform.cli.run_conversion import (
    TARGETS,
    ConversionJob,
    Options,
    Target,
    jobs,
    jobs_in_place,
    print_plan,
    run_into,
    run_job,
    run_split,
)
from twinform.compiler import ConversionRequest
from twinform.compiler.input.load_options import ReadingOptions
from twinform.dataclass import dataclass
from twinform.request_options import RequestOptions

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
@request_options
@click.option(
    "--ledger", type=click.Path(path_type=Path), metavar="FILE", help="Where to write what was not expressed."
)
@click.option(
    "--depfile",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Where to list the files that OUT is made of, for make, Ninja and CMake; success prints nothing then.",
)
@companion_options
@click.option("--model", metavar="NAME", help="The model of the file to convert, whatever it becomes.")
@notes_option
@all_option
@policy_options
@click.option(
    "--split",
    is_flag=True,
    help="Write each model of a world into the directory OUT, and an SDF that includes them: SDF, or with --to urdf "
    "URDF where Gazebo reads that as the same robot.",
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
    request: RequestOptions,
    ledger: Path | None,
    depfile: Path | None,
    gazebo_files: GazeboFiles,
    model: str | None,
    split: bool,
    audit: bool,
    check: bool,
    print_pipeline: bool,
    watching: InstrumentationOptions,
    in_place: bool,
    into: Path | None,
    base: Path | None,
    notes: bool,
    every: bool,
    reading: ReadingOptions,
    **_options: object,
) -> None:
    """Compile robot models from one format into the other.

    IN are URDF, SDF, MJCF, xacro or JSON files; - is standard input. Arguments of xacro are written NAME:=VALUE. All
    that is asked for is written at once, or, where an input has an error, nothing. No file is written over one that is
    read. Exit code: 0 without errors, 1 with errors or where --check finds a difference, 2 where a file could not be
    read or written.
    """
    sources, arguments = inputs(words)
    by_file = OptionsByFile(ctx, arguments)

    def complete(given: RequestOptions) -> ConversionRequest:
        wanted: RequestOptions = {**given}
        if ctx.get_parameter_source("gazebo") is not ParameterSource.DEFAULT:
            wanted["sdf_version"] = version_for(gazebo_files.gazebo, given.get("sdf_version"))
        return ConversionRequest.of("sdf", whole_request(wanted, reading, model=model, keep_physics=keep_physics))

    load_options, policy, _, _ = by_file.usual
    options = Options(
        request=complete(request),
        complete=complete,
        load_options=load_options,
        ledger=ledger,
        depfile=depfile,
        notes=notes,
        every=every,
        policy=policy,
        watching=watching,
        audit=audit,
        gazebo_files=gazebo_files,
    )
    run = _ConvertRun(
        ctx, sources, by_file, options.for_file(by_file.of(sources[0].name)) if len(sources) == 1 else options
    )
    run.require_one_input(split=split)
    _require_consumers(profiles, alone=not (split or into), keep_physics=keep_physics)
    if split:
        folder = _split_folder(out, target, model, in_place=in_place)
        ctx.exit(run.split_world(target or "sdf", folder, check=check))
    if into or base:
        if out or in_place or target or request.get("passes") or depfile:
            raise click.UsageError(
                "--into says what is written: leave -o, --in-place, --to, --passes and --depfile out"
            )
        ctx.exit(run.update(into, base, check=check))
    todo = jobs_in_place(sources, out, target) if in_place else jobs(sources, out, target)
    _require_sdf(ctx, todo)
    ctx.exit(run.print_pipelines(todo) if print_pipeline else run.convert(todo, in_place=in_place, check=check))


@dataclass(frozen=True, slots=True)
class _ConvertRun:
    """The inputs of one run and their options; each mode returns the exit code."""

    ctx: click.Context
    sources: Sequence[InputSource]
    by_file: OptionsByFile
    options: Options

    def require_one_input(self, *, split: bool) -> None:
        """Refuse several inputs for options that take one."""
        several = len(self.sources) > 1
        if self.options.ledger is not None and several:
            raise click.UsageError("--ledger takes one input")
        if self.options.depfile is not None and (split or several):
            raise click.UsageError("--depfile takes one input, and no --split")
        if self.options.gazebo_files and (split or several):
            raise click.UsageError("--bridge and --world take one input, and no --split")
        if self.options.beside and several:
            raise click.UsageError(f"a pass writes {self.options.beside[0]} beside the result; that takes one input")

    def split_world(self, target: Target, folder: Path, *, check: bool) -> int:
        """Write the models of a world and an SDF that includes them into a folder."""
        outputs = self._outputs(check=check)
        return self._write_all(outputs, [run_split(_single(self.sources), target, self.options, folder, outputs)])

    def update(self, into: Path | None, base: Path | None, *, check: bool) -> int:
        """Update a file of the other format with the edits of the input."""
        outputs = self._outputs([into] if into else (), check=check)
        return self._write_all(outputs, [run_into(_single(self.sources, "--into"), into, base, self.options, outputs)])

    def print_pipelines(self, todo: Sequence[ConversionJob]) -> int:
        """Print the passes that would run."""
        return max(print_plan(job, self._options_for(job), label=_label(job, todo)) for job in todo)

    def convert(self, todo: Sequence[ConversionJob], *, in_place: bool, check: bool) -> int:
        """Write new files, or change the inputs themselves."""
        planned = [(job, self._options_for(job)) for job in todo]
        outputs = self._outputs([job.path for job in todo if in_place and job.path], check=check)
        outputs.require_apart([place for job, own in planned for place in own.places(job, outputs)])
        depfile = self.options.depfile
        if depfile:
            codes = [self._run_with_depfile(*planned[0], depfile, outputs)]
        else:
            codes = [run_job(job, own, _label(job, todo), outputs) for job, own in planned]
        if in_place and not max(codes):
            self._follow(planned, outputs)
        return self._write_all(outputs, codes)

    def _run_with_depfile(self, job: ConversionJob, own: Options, depfile: Path, outputs: Outputs) -> int:
        """Run one conversion, and list the files that it reads and those with its settings."""
        from twinform.cli.depfile import depfile_text, read_by  # noqa: PLC0415 - build systems alone want it

        if job.path is None or job.in_place:
            raise click.UsageError("--depfile is about a file that is made: name it with -o")
        code, read = read_by(lambda: run_job(job, own, "", outputs))
        contexts = (self.ctx, self.by_file.context_of(job.source.name))
        settings = [path for each in contexts if (path := settings_of(each).path)]
        outputs.add("--depfile", depfile, depfile_text(job.path, [*read, *settings]))
        return code

    def _follow(self, planned: "Sequence[tuple[ConversionJob, Options]]", outputs: Outputs) -> None:
        """Add the files that name parts which passes have renamed."""
        for job, own in planned:
            if job.path in outputs.as_read:
                found = followed_files({job.path: outputs.as_read[job.path]}, own.request.passes, own.load_options)
                for each in found:
                    outputs.as_read[each.path] = each.before
                    outputs.add("--in-place", each.path, each.after)
                    outputs.news += describe_followed(each)

    def _options_for(self, job: ConversionJob) -> Options:
        return self.options.for_file(self.by_file.of(job.source.name))

    def _outputs(self, rewritten: Sequence[Path] = (), *, check: bool) -> Outputs:
        settings = settings_of(self.ctx).path
        read = [*(source.path for source in self.sources), *([settings] if settings else [])]
        return Outputs(read, rewritten, check)

    def _write_all(self, outputs: Outputs, codes: Sequence[int]) -> int:
        """Write everything, or nothing if an input has an error."""
        if not max(codes):
            return outputs.write(self.options.load_options.search.seen)
        if len(codes) > 1:
            wrong = sum(map(bool, codes))
            print_line(f"nothing is written: {wrong} of {len(codes)} inputs could not be converted", err=True)
        return max(codes)


def _require_consumers(profiles: "tuple[Profile, ...]", *, alone: bool, keep_physics: bool) -> None:
    """Refuse options that contradict `--for`, or need it."""
    if keep_physics and not profiles:
        raise click.UsageError("--keep-physics is for --for")
    if not alone and any(each.named for each in profiles):
        raise click.UsageError("--for takes neither --split nor --into")


def _require_sdf(ctx: click.Context, todo: Sequence[ConversionJob]) -> None:
    """Refuse a version of SDF if nothing becomes SDF."""
    versioned = ctx.get_parameter_source("sdf_version") is ParameterSource.COMMANDLINE
    if versioned and all(job.target != "sdf" for job in todo):
        raise click.UsageError("--sdf-version is for --to sdf")


def _label(job: ConversionJob, todo: Sequence[ConversionJob]) -> str:
    """Return the prefix of messages about a job, if there are several."""
    return job.source.name if len(todo) > 1 else ""


def _single(sources: Sequence[InputSource], option: str = "--split") -> InputSource:
    if len(sources) > 1:
        raise click.UsageError(f"{option} takes one input")
    return sources[0]


def _split_folder(out: str | None, target: Target | None, model: str | None, *, in_place: bool) -> Path:
    """Return the directory for the files of a world that is split."""
    if in_place or out is None or out == "-" or (Path(out).exists() and not Path(out).is_dir()):
        raise click.UsageError("--split needs -o DIRECTORY")
    if target in {"json", "mjcf"} or model is not None:
        raise click.UsageError("--split makes a file of every model, URDF or SDF; leave --model out")
    return Path(out)
