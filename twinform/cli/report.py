"""`twinform report`."""

from pathlib import Path

import click

from twinform.cli.command import FINDINGS, UNUSABLE, Command
from twinform.cli.completion import files
from twinform.cli.diff import comparison_options
from twinform.cli.inputs import file_options, inputs, load_options_of
from twinform.cli.outputs import Outputs, output_option
from twinform.cli.printing import show
from twinform.compiler import CompileError
from twinform.compiler.compare import ComparisonOptions
from twinform.compiler.input.load_options import FileOptions
from twinform.diagnostics.reporters import FileFindings
from twinform.report import WRITERS, build_report
from twinform.report.content import make_page

_MOST = 2
_SUFFIXES = {".md": "md", ".markdown": "md"}
EXAMPLES = {
    "Make a page that opens offline": "twinform report robot.urdf -o out/report.html",
    "Show what has changed between two files": "twinform report robot.urdf robot.sdf -o out/report.html",
    "Write a comment for a pull request": "twinform report robot.urdf robot.sdf -o out/report.md",
}


@click.command("report", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="A [B] [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@output_option
@click.option(
    "--format",
    "style",
    type=click.Choice(list(WRITERS)),
    help="The form; by default that of the name of FILE, or HTML.",
)
@click.option("--view/--no-view", default=True, help="Whether the 3D view is in it, about 0.8 MB.")
@click.option("--meshes/--no-meshes", default=True, help="Whether to count the triangles of mesh files.")
@click.option("--model", metavar="NAME", help="The model to convert and compare, where a file has several.")
@comparison_options
@file_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    output: Path | None,
    style: str | None,
    *,
    view: bool,
    meshes: bool,
    model: str | None,
    comparison: ComparisonOptions,
    reading: FileOptions,
) -> None:
    """Write a report on a model, or on two, that opens offline.

    One page: the 3D view, the tree, findings with their lines, what becomes of each part in the other format, numbers,
    masses and inertias; with B what differs and by how much. It asks for nothing from elsewhere. A and B are URDF,
    SDF, MJCF, xacro or JSON files; - is standard input. Arguments of xacro are written NAME:=VALUE. Exit code: 0
    without errors, 1 where a file has errors, which are in the report, 2 where one could not be read: then there is
    none.
    """
    sources, arguments = inputs(words)
    if len(sources) > _MOST:
        raise click.UsageError("report takes one file or two")
    first, second = sources[0], sources[1] if len(sources) == _MOST else None
    style = style or (_SUFFIXES.get(output.suffix.lower()) if output else None) or "html"
    try:
        found = build_report(
            first.content,
            second.content if second else None,
            load_options_of(arguments, reading),
            names=(first.name, second.name if second else ""),
            model=model,
            options=comparison,
            meshes=meshes,
            view=make_page if view and style == "html" else None,
        )
    except CompileError as error:
        show(FileFindings(first.name, error.diagnostics), notes=False, on_stderr=True)
        ctx.exit(UNUSABLE)
    if found.unreadable:
        for subject in found.subjects:
            if subject.loaded.unreadable:
                show(FileFindings(subject.loaded.path, subject.loaded.diagnostics), notes=False, on_stderr=True)
        ctx.exit(UNUSABLE)
    outputs, text = Outputs(inputs=[source.path for source in sources]), WRITERS[style](found)
    outputs.set_result(output, text)
    if view and style == "html" and not found.view and found.accepted:
        outputs.news.append(f"note: the report has no 3D view: {found.without_view}")
    outputs.write()
    ctx.exit(0 if found.accepted else FINDINGS)
