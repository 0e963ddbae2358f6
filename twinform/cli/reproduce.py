"""`twinform reproduce`."""

import traceback
from pathlib import Path

import click

from twinform import __version__
from twinform.cli.command import FINDINGS, Command, Unusable
from twinform.cli.config_trust import Outside
from twinform.cli.printing import paint, print_line, print_text
from twinform.compiler import LoadOptions
from twinform.compiler.expand_includes import OtherDocuments
from twinform.compiler.reproducers import Reproducer, read_reproducer
from twinform.compiler.resolve_uris import LocalAssets, SearchPath
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.reporters import FileFindings, concise
from twinform.passes import PassError, PipelineError, RegistryError
from twinform.storage.writing import is_below

EXAMPLES = {
    "Run the pass again of which a fault has left a file": "twinform reproduce twinform-fault.json",
}


@click.command("reproduce", cls=Command, examples=EXAMPLES)
@click.argument("file", type=click.Path(path_type=Path))
@click.option(
    "--path",
    "paths",
    metavar="DIR",
    multiple=True,
    type=click.Path(exists=True, file_okay=False, path_type=Path),
    help="A folder of models or packages, for passes that open files; repeatable.",
)
@click.pass_context
def command(ctx: click.Context, file: Path, paths: tuple[Path, ...]) -> None:
    """Run a pass again that failed.

    It is given the document that it failed on. FILE is what `twinform convert` names where a pass is at fault. Exit
    code: 0 the pass does its work now, 1 it fails again, with the whole traceback, 2 the file could not be read. Meshes
    and other models are read in the folder of FILE, and in those of --path.
    """
    found = _read(file)
    print_line(f"{found.pipeline} on a document of {found.source}; failed under twinform {found.twinform}", err=True)
    if found.twinform != __version__:
        print_line(f"this is twinform {__version__}", err=True)
    sink = DiagnosticSink(found.source)
    error = _run(found, file, SearchPath.of(paths), sink)
    print_text(concise([FileFindings(found.source, tuple(sink.diagnostics))], paint), nl=False, err=True)
    if error is None:
        other = "" if found.again else ", as it did when this file was written: it needs the source, lines and all"
        print_line(f"it does not fail{other}", err=True)
        ctx.exit(0)
    cause = error.__cause__
    print_text("".join(traceback.format_exception(cause)) if cause else str(error), err=True, nl=cause is None)
    ctx.exit(FINDINGS)


def _read(file: Path) -> Reproducer:
    try:
        return read_reproducer(file)
    except OSError as error:
        raise Unusable(f"cannot read {file}: {error.strerror}") from error
    except ValueError as error:
        raise Unusable(f"{file} is no reproducer: {str(error).splitlines()[0]}") from error


def _run(found: Reproducer, file: Path, search: SearchPath, sink: DiagnosticSink) -> PassError | None:
    # a reproducer may be anybody's, so the source that it names opens no folder but its own
    source = Path(found.source)
    if not is_below(source, file.parent):
        source = file.with_name(source.name or file.name)
    assets = LocalAssets(search, source)
    reader = OtherDocuments(LoadOptions(search=search), str(source)).read
    try:
        return found.run(assets, reader, Outside(file.parent, f"{file}, which names it"), sink)
    except (PipelineError, RegistryError) as error:
        raise Unusable(f"{file}: {error}") from error
