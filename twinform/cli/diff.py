"""`twinform diff`."""

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command
from twinform.cli.completion import files
from twinform.cli.flags import group
from twinform.cli.inputs import file_options, inputs, load_options_of
from twinform.cli.printing import Color, print_report, print_text, show, styled
from twinform.compiler import CompileError
from twinform.compiler.compare import TOLERANCE, ComparisonOptions, DifferenceSeverity, compare_files
from twinform.compiler.compare.comparison_reporters import REPORTERS, summary, text
from twinform.compiler.input.load_options import FileOptions
from twinform.diagnostics.reporters import FileFindings


def _options(tolerance: float, *, read_carriers: bool) -> ComparisonOptions:
    return ComparisonOptions(tolerance, read_carriers)


tolerance_option = click.option(
    "--tolerance",
    type=click.FloatRange(min=0),
    default=TOLERANCE,
    show_default=True,
    help="The relative difference that counts as rounding; absolute for positions (m) and angles (rad).",
)
comparison_options = group(
    "comparison",
    _options,
    tolerance_option,
    click.option(
        "--carriers/--no-carriers",
        "read_carriers",
        default=False,
        help="Whether what only carriers say counts as written, or is a difference of its own kind.",
    ),
)
"""Gives a command the options of how robots are compared."""


_COLORS: dict[DifferenceSeverity, Color] = {
    DifferenceSeverity.DIFFERENCE: "red",
    DifferenceSeverity.CARRIED: "yellow",
    DifferenceSeverity.NOTE: "cyan",
}
_PAIR = 2


EXAMPLES = {
    "Is it the same robot?": "twinform diff robot.urdf robot.sdf",
    "Count what only twinform reads as written": "twinform diff robot.urdf robot.sdf --carriers",
    "Has a converter to USD lost anything?": "twinform diff robot.urdf robot.usda",
    "Allow for rounding": "twinform diff robot.urdf robot.sdf --tolerance 1e-6",
}


@click.command("diff", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="A B [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@click.option("--format", "style", type=click.Choice(list(REPORTERS)), default="text", help="How to print differences.")
@click.option("--model", metavar="NAME", help="The model to compare, where a file has several.")
@comparison_options
@file_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    style: str,
    *,
    model: str | None,
    comparison: ComparisonOptions,
    reading: FileOptions,
) -> None:
    """Say whether two files describe the same robot.

    Prints what differs, where and by how much; what is carried, which means that only a carrier or <gazebo> says it,
    and other readers see two robots; and notes on what is only written in another way. A and B are URDF, SDF, MJCF,
    xacro or JSON files, mixed as it comes, or USD, which no other command reads; - is standard input. Arguments of
    xacro are written NAME:=VALUE. Exit code: 0 the same robot, 1 another one, 2 where a file could not be read or has
    errors.
    """
    sources, arguments = inputs(words)
    if len(sources) != _PAIR:
        raise click.UsageError("diff compares two files")
    a, b = sources
    try:
        load_options, names = load_options_of(arguments, reading), (a.name, b.name)
        found = compare_files(a.content, b.content, load_options, comparison, names=names, model=model)
    except CompileError as error:
        show(FileFindings(a.name, error.diagnostics), notes=False, on_stderr=True)
        ctx.exit(UNUSABLE)
    print_report(text(found, _paint) if style == "text" else REPORTERS[style](found), style)
    print_text(summary(found), err=True)
    ctx.exit(0 if found.same else FINDINGS)


def _paint(word: str, severity: DifferenceSeverity) -> str:
    return styled(word, _COLORS[severity])
