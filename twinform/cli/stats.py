"""`twinform stats`."""

from typing import Unpack

import click

from twinform.cli.failure import FINDINGS, UNUSABLE
from twinform.cli.findings import show
from twinform.cli.inputs import HowToRead, how_to_read, inputs, reading_options
from twinform.compiler import expand, read
from twinform.compiler.statistics import REPORTERS, FileStatistics, measure
from twinform.diagnostics.reporters import Findings


@click.command("stats")
@click.argument("words", metavar="IN... [NAME:=VALUE...]", nargs=-1, required=True)
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
    expand_includes: bool,
    **how: Unpack[HowToRead],
) -> None:
    """Say in numbers what models are made of.

    Prints, for each model of each file, links, joints, degrees of freedom, mass, shapes, what meshes cost, sensors and
    plugins. IN are URDF, SDF, xacro or JSON files; - is standard input. Arguments of xacro are written NAME:=VALUE.
    Exit code: 0 without errors, 1 where a file has errors, 2 where one could not be read.
    """
    sources, arguments = inputs(words)
    reading, code = how_to_read(arguments, how), 0
    found: list[FileStatistics] = []
    for source in sources:
        checked = read(source.content, reading, name=source.name)
        checked = expand(checked, reading) if expand_includes else checked
        if checked.document is None or not checked.accepted:
            show(Findings(checked.path, checked.diagnostics), notes=False, on_stderr=True)
            code = max(code, UNUSABLE if checked.unreadable else FINDINGS)
        else:
            found.append(measure(checked, checked.document, reading.search, meshes=meshes))
    if found or style == "json":
        click.echo(REPORTERS[style](found), nl=False)
    ctx.exit(code)
