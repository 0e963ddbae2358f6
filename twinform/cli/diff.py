"""`twinform diff`."""

import click

from twinform.cli.command import Command
from twinform.cli.comparison_options import comparison_options
from twinform.cli.completion import files
from twinform.cli.failure import FINDINGS, UNUSABLE
from twinform.cli.inputs import file_options, inputs, load_options_of
from twinform.cli.print_findings import show
from twinform.cli.printing import Color, print_report, print_text, styled
from twinform.compiler import CompileError
from twinform.compiler.compare import ComparisonOptions, DifferenceSeverity, compare_files
from twinform.compiler.compare.comparison_reporters import REPORTERS, summary, text
from twinform.compiler.input.load_options import FileOptions
from twinform.diagnostics.reporters import FileFindings

_COLORS: dict[DifferenceSeverity, Color] = {
    DifferenceSeverity.DIFFERENCE: "red",
    DifferenceSeverity.CARRIED: "yellow",
    DifferenceSeverity.NOTE: "cyan",
}
_PAIR = 2


EXAMPLES = {
    "Is it the same robot?": "twinform diff robot.urdf robot.sdf",
    "Count what only twinform reads as written": "twinform diff robot.urdf robot.sdf --carriers",
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
    and other readers see two robots; and notes on what is only written in another way. A and B are URDF, SDF,
    xacro or JSON files, mixed as it comes; - is standard input. Arguments of xacro are written NAME:=VALUE. Exit code:
    0 the same robot, 1 another one, 2 where a file could not be read or has errors.
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
