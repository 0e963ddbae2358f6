"""`twinform stats`."""

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command
from twinform.cli.completion import files
from twinform.cli.inputs import inputs, load_options_of, read_model, reading_options
from twinform.cli.printing import print_report, show
from twinform.compiler.input.load_options import ReadingOptions
from twinform.compiler.statistics import FileStatistics, measure
from twinform.compiler.statistics_reporters import REPORTERS
from twinform.diagnostics.reporters import FileFindings

EXAMPLES = {
    "Count links, joints, masses and triangles": "twinform stats robot.urdf",
    "The same for a program": "twinform stats robot.urdf robot.sdf --format json",
}


@click.command("stats", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="IN... [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@click.option("--format", "style", type=click.Choice(list(REPORTERS)), default="text", help="How to print the numbers.")
@click.option("--meshes/--no-meshes", default=True, help="Whether to look into mesh files.")
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    style: str,
    *,
    meshes: bool,
    reading: ReadingOptions,
) -> None:
    """Print in numbers what models are made of.

    Prints, for each model of each file, links, joints, degrees of freedom, mass, shapes, what meshes and sensors cost,
    plugins, and which passes would make it cheaper. IN are URDF, SDF, MJCF, xacro or JSON files; - is standard input.
    Arguments of xacro are written NAME:=VALUE. Exit code: 0 without errors, 1 where a file has errors, 2 where one
    could not be read.
    """
    sources, arguments = inputs(words)
    load_options, code = load_options_of(arguments, reading), 0
    found: list[FileStatistics] = []
    for source in sources:
        loaded = read_model(source, load_options, reading)
        if loaded.document is None or not loaded.accepted:
            show(FileFindings(loaded.path, loaded.diagnostics), notes=False, on_stderr=True)
            code = max(code, UNUSABLE if loaded.unreadable else FINDINGS)
        else:
            found.append(measure(loaded, loaded.document, load_options.search, meshes=meshes))
    if found or style == "json":
        print_report(REPORTERS[style](found), style)
    ctx.exit(code)
