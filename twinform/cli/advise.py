"""`twinform advise`."""

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command
from twinform.cli.completion import consumers, files
from twinform.cli.inputs import file_options, inputs, load_options_of
from twinform.cli.printing import print_report, show
from twinform.compiler import CompileError
from twinform.compiler.advice_reporters import REPORTERS
from twinform.compiler.advising import advise
from twinform.compiler.input.load_options import FileOptions
from twinform.diagnostics.reporters import FileFindings
from twinform.profiles import Profile, UnknownProfileError, load, names, parse
from twinform.profiles.profile import PORTABLE

EXAMPLES = {
    "Which format, and who takes it?": "twinform advise robot.urdf",
    "What would two of them lose?": "twinform advise robot.sdf --for drake,mujoco",
    "The same for a program": "twinform advise robot.urdf --format json",
}


def _parse_consumers(_ctx: click.Context, _option: click.Parameter, value: str | None) -> tuple[Profile, ...]:
    """Return the profiles of the consumers that are named, or else of all."""
    if value is None:
        return tuple(profile for name in names() if name != PORTABLE for profile in load(name))
    try:
        return parse(value)
    except UnknownProfileError as error:
        raise click.BadParameter(str(error)) from error


@click.command("advise", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="IN [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@click.option(
    "--for",
    "profiles",
    metavar="NAME,...",
    callback=_parse_consumers,
    shell_complete=consumers,
    help="Ask these consumers; else all.",
)
@click.option("--model", metavar="NAME", help="The model to convert, where a file has several.")
@click.option("--format", "style", type=click.Choice(list(REPORTERS)), default="text", help="How to print the advice.")
@file_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    profiles: tuple[Profile, ...],
    model: str | None,
    style: str,
    *,
    reading: FileOptions,
) -> None:
    """Say which format to keep a robot in, and who takes it.

    The reasons are measured: the model is converted into the other format, and the profiles of all consumers are asked
    about both. IN is a URDF, SDF, MJCF, xacro or JSON file; - is standard input. Arguments of xacro are written
    NAME:=VALUE. Exit code: 0 where there is advice, 1 where the file has errors, 2 where it could not be read.
    """
    sources, arguments = inputs(words)
    if len(sources) != 1:
        raise click.UsageError("advise takes one input")
    source, load_options = sources[0], load_options_of(arguments, reading)
    try:
        found = advise(source.content, profiles, load_options, name=source.name, model=model)
    except CompileError as error:
        show(FileFindings(source.name, error.diagnostics), notes=False, on_stderr=True)
        ctx.exit(UNUSABLE if error.unreadable else FINDINGS)
    print_report(REPORTERS[style](found), style)
