"""`twinform view`."""

import contextlib
import threading
import webbrowser
from collections.abc import Generator, Sequence
from dataclasses import field
from typing import TYPE_CHECKING

import click

from twinform.cli.command import UNUSABLE, Command, Unusable
from twinform.cli.completion import files
from twinform.cli.inputs import InputSource, file_options, inputs, load_options_of
from twinform.cli.printing import print_line, show
from twinform.compiler import CompileError, LoadOptions
from twinform.compiler.input.load_options import FileOptions
from twinform.dataclass import dataclass
from twinform.diagnostics import Diagnostic
from twinform.diagnostics.reporters import FileFindings
from twinform.signals import signals_exit_with

if TYPE_CHECKING:
    from twinform.compiler.compare import Comparison
    from twinform.view import ViewSubject
    from twinform.view.viewer import Viewer

_MOST = 2
EXAMPLES = {
    "Look at a robot": "twinform view robot.urdf",
    "Two robots overlaid, with what differs in color": "twinform view robot.urdf robot.sdf",
    "Show it again whenever the file is saved": "twinform view robot.urdf --watch",
}


@click.command("view", cls=Command, examples=EXAMPLES)
@click.argument("words", metavar="A [B] [NAME:=VALUE...]", nargs=-1, required=True, shell_complete=files)
@click.option("--port", type=click.IntRange(0, 65535), default=0, metavar="N", help="The port; by default a free one.")
@click.option("--open/--no-open", "opens", default=True, help="Whether to open a browser.")
@click.option("--watch", is_flag=True, help="Show a file again when it is saved, or one that it is made from.")
@file_options
@click.pass_context
def command(
    ctx: click.Context,
    words: tuple[str, ...],
    port: int,
    *,
    opens: bool,
    watch: bool,
    reading: FileOptions,
) -> None:
    """Show a robot or world in a browser, or two overlaid.

    Shows visuals, collisions, frames, joint axes and limits, masses and sensors, with a slider for each joint, the
    tree, and what was found, on the part that it is about. Until Ctrl-C a server on this machine alone listens. A and B
    are URDF, SDF, MJCF, xacro or JSON files; - is standard input. Arguments of xacro are written NAME:=VALUE. Exit
    code: 0, or 2 where a file could not be read.
    """
    sources, arguments = inputs(words)
    if len(sources) > _MOST:
        raise click.UsageError("view shows one file or two")
    load_options = load_options_of(arguments, reading)
    session = _Session(sources, load_options, port, opens=opens)
    try:
        if watch and "-" in words:
            raise click.UsageError("--watch shows files: leave - out")
        ctx.exit(session.watch(words) if watch else session.run())
    finally:
        session.stop()


def _line(found: Diagnostic) -> str:
    place = found.location
    return f"line {place.line}: {found.message}" if place.line else found.message


@contextlib.contextmanager
def _until_stopped() -> Generator[None]:
    """Run the block until Ctrl-C, or until a signal asks the program to end."""
    with signals_exit_with(0), contextlib.suppress(KeyboardInterrupt):
        yield


@dataclass(slots=True)
class _Session:
    """The server of the view, and the files that it shows."""

    sources: Sequence[InputSource]
    load_options: LoadOptions
    port: int
    opens: bool
    viewer: "Viewer | None" = field(default=None, init=False)
    complaints: list[tuple[str, list[str]]] = field(default_factory=list[tuple[str, list[str]]], init=False)

    def run(self) -> int:
        """Show the files until Ctrl-C."""
        with _until_stopped():
            if not self.show():
                return UNUSABLE
            threading.Event().wait()
        return 0

    def watch(self, words: Sequence[str]) -> int:
        """Show the files whenever one of them changes; if one cannot be read, its last state stays."""
        from twinform.cli.watching import watch_models  # noqa: PLC0415 - it seldom happens

        round_ = _Round(self)
        with _until_stopped():
            watch_models(lambda: inputs(words)[0], lambda: round_, lambda source, _: round_.read(source))
        return 0

    def show(self) -> bool:
        """Read the files and show them; return whether all could be read."""
        return self.show_subjects([self.read(source) for source in self.sources])

    def read(self, source: InputSource) -> "ViewSubject | None":
        """Read a file for the view; print its findings if there is nothing to show."""
        from twinform.view import read_subject  # noqa: PLC0415 - the help needs no view

        subject, loaded = read_subject(source.content, self.load_options, name=source.name)
        if subject is None:
            self._complain(f"{source.name} cannot be shown", loaded.path, loaded.diagnostics)
        return subject

    def show_subjects(self, subjects: "Sequence[ViewSubject | None]") -> bool:
        """Show the files that could be read; return whether all could."""
        found = [subject for subject in subjects if subject is not None]
        if len(found) < len(subjects) or not found:
            self._warn("; what could be read last is shown")
            return False
        viewer, is_new = self.viewer or self._start(), self.viewer is None
        self.viewer = viewer
        viewer.show(found, self._comparison())
        self._warn()
        if is_new:
            print_line(
                f"showing {' and '.join(source.name for source in self.sources)} at {viewer.address}; Ctrl-C ends"
            )
            if self.opens:
                webbrowser.open(viewer.address)
        return True

    def _warn(self, but: str = "") -> None:
        """Show new errors in the page."""
        for title, lines in self.complaints:
            if self.viewer is not None:
                self.viewer.warn(f"{title}{but}", lines)
        self.complaints.clear()

    def stop(self) -> None:
        """End the server."""
        if self.viewer is not None:
            self.viewer.stop()

    def _start(self) -> "Viewer":
        from twinform.view import ViewError, new_viewer  # noqa: PLC0415 - see above

        try:
            return new_viewer(self.port)
        except ViewError as error:
            raise Unusable(str(error)) from error

    def _comparison(self) -> "Comparison | None":
        if len(self.sources) < _MOST:
            return None
        from twinform.compiler.compare import compare_files  # noqa: PLC0415 - most calls have one file

        a, b = self.sources
        try:
            return compare_files(a.content, b.content, self.load_options, names=(a.name, b.name))
        except CompileError as error:
            self._complain("the two cannot be compared", a.name, error.diagnostics)
            return None

    def _complain(self, title: str, name: str, diagnostics: tuple[Diagnostic, ...]) -> None:
        """Print what is wrong, and keep it for the page."""
        show(FileFindings(name, diagnostics), notes=False, on_stderr=True)
        self.complaints.append((title, [_line(each) for each in diagnostics if each.is_error]))


@dataclass(slots=True)
class _Round:
    """The files as they were last read, after one or both have changed."""

    session: _Session
    subjects: "dict[str, ViewSubject | None]" = field(default_factory=dict[str, "ViewSubject | None"])

    def read(self, source: InputSource) -> None:
        """Read a file again."""
        self.subjects[source.name] = self.session.read(source)

    def end(self) -> None:
        """Show the files."""
        names = [source.name for source in self.session.sources]
        self.session.show_subjects([self.subjects.get(name) for name in names])
