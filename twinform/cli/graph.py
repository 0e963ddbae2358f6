"""`twinform graph`."""

from pathlib import Path

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command
from twinform.cli.completion import files
from twinform.cli.inputs import inputs, load_options_of, read_model, reading_options
from twinform.cli.outputs import Outputs, output_option
from twinform.cli.printing import show
from twinform.compiler.graph import WRITERS, build_graph
from twinform.compiler.graph.languages import MOST_CHARACTERS, MOST_EDGES, fits
from twinform.compiler.input.load_options import ReadingOptions
from twinform.diagnostics.reporters import FileFindings

_SUFFIXES = {".mmd": "mermaid", ".mermaid": "mermaid", ".dot": "dot", ".gv": "dot", ".svg": "svg"}
EXAMPLES = {
    "Print links and joints for a page in Markdown": "twinform graph robot.urdf",
    "Draw them, with frames and mimics": "twinform graph robot.sdf -o out/robot.svg --frames --mimics",
    "Make a picture with Graphviz": "twinform graph robot.urdf -o out/robot.dot",
}


@click.command("graph", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="IN [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@output_option
@click.option(
    "--format",
    "style",
    type=click.Choice(list(WRITERS)),
    help="The language; by default that of the name of FILE, or Mermaid.",
)
@click.option("--frames", is_flag=True, help="Show named frames, and what they are attached to.")
@click.option("--mimics", is_flag=True, help="Show which joints follow others.")
@reading_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    output: Path | None,
    style: str | None,
    *,
    frames: bool,
    mimics: bool,
    reading: ReadingOptions,
) -> None:
    """Draw the links and joints of a model or world.

    Nested models and the models of a world are in clusters, types and limits of joints in their labels. What is named
    and not there is drawn too, dashed, so that a broken model can be looked at. IN is a URDF, SDF, MJCF, xacro or JSON
    file; - is standard input. Arguments of xacro are written NAME:=VALUE. Exit code: 0 without errors, 1 where the file
    has errors, 2 where it could not be read.
    """
    sources, arguments = inputs(words)
    if len(sources) != 1:
        raise click.UsageError("graph draws one input")
    load_options = load_options_of(arguments, reading)
    loaded = read_model(sources[0], load_options, reading)
    if not loaded.accepted:
        show(FileFindings(loaded.path, loaded.diagnostics), notes=False, on_stderr=True)
    if loaded.document is None:
        ctx.exit(UNUSABLE if loaded.unreadable else FINDINGS)
    style = style or (_SUFFIXES.get(output.suffix.lower()) if output else None) or "mermaid"
    graph = build_graph(loaded.document, frames=frames, mimics=mimics)
    text = WRITERS[style](graph)
    outputs = Outputs(inputs=[sources[0].path])
    outputs.set_result(output, text)
    if style == "mermaid" and not fits(graph, text):
        outputs.news.append(
            f"note: where Mermaid has its usual settings, as on GitHub, it draws at most {MOST_EDGES} edges and "
            f"{MOST_CHARACTERS:,} characters, and this is more: --format svg has no such limit"
        )
    outputs.write()
    ctx.exit(0 if loaded.accepted else FINDINGS)
