"""Instrumentation of passes: options that print the IR, changes and times, progress, and reports of failed passes."""

import sys
from collections.abc import Generator, Iterable
from contextlib import contextmanager
from dataclasses import field
from importlib.util import find_spec
from pathlib import Path

import click

from twinform.cli.command import UNUSABLE
from twinform.cli.flags import group
from twinform.cli.printing import print_line, print_text
from twinform.dataclass import dataclass
from twinform.diagnostics.reporters import printable
from twinform.passes import CombinedInstrumentation, FilesPass, Pass, PassError, PassInstrumentation
from twinform.passes.framework.hooks import Dumps, Statistics, table

_OPTIONS = (
    click.option(
        "--dump-ir-after", "dumps", metavar="PASS", multiple=True, help="Print the IR after a pass on stderr."
    ),
    click.option("--print-changes", "changes", is_flag=True, help="Print on stderr what each pass changes in the IR."),
    click.option(
        "--time-passes", "times", is_flag=True, help="Print on stderr how long each pass takes, and what it does."
    ),
    click.option("--pass-statistics", "statistics", is_flag=True, help="The same without times."),
    click.option(
        "--reproducers",
        type=click.Path(file_okay=False, path_type=Path),
        metavar="DIR",
        help="Where to write a reproducer when a pass fails; else the current folder.",
    ),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class InstrumentationOptions:
    """The values of the options that observe passes."""

    dumps: tuple[str, ...] = ()
    changes: bool = False
    times: bool = False
    statistics: bool = False
    reproducers: Path | None = None

    def begin(self, name: str) -> "InputInstrumentation":
        """Begin to observe the passes of one input, which messages call `name`."""
        return InputInstrumentation(self, name)


watching_options = group("watching", InstrumentationOptions, *_OPTIONS)
"""Gives a command the options that observe passes."""


@dataclass(slots=True)
class InputInstrumentation:
    """The instrumentation of the passes of one input."""

    options: InstrumentationOptions
    name: str
    _dumps: Dumps = field(init=False)
    _statistics: Statistics | None = field(init=False)

    def __post_init__(self) -> None:
        self._dumps = Dumps(self.options.dumps, self._dump)
        self._statistics = Statistics() if self.options.times or self.options.statistics else None

    @property
    def instrumentation(self) -> PassInstrumentation:
        """Everything that observes the passes; the clock comes last, to be nearest to them."""
        watching: list[PassInstrumentation] = [self._dumps]
        if self.options.changes:
            from twinform.passes.framework.hooks import PrintChanges  # noqa: PLC0415 - few ask for changes

            watching.append(PrintChanges(self._print))
        return CombinedInstrumentation([*watching, *([self._statistics] if self._statistics else [])])

    def end(self) -> None:
        """Print the statistics after all passes.

        Raises:
            click.UsageError: a pass that an option names did not run.
        """
        self.report()
        for each in self.options.dumps:
            if each not in self._dumps.seen:
                ran = ", ".join(self._dumps.seen) or "none"
                raise click.UsageError(f"--dump-ir-after {each}: no such pass ran; there were {ran}")

    def report(self) -> None:
        """Print the statistics, if they are asked for."""
        if self._statistics:
            self._print(f"passes\n{table(self._statistics, times=self.options.times)}")

    def fault(self, error: PassError) -> None:
        """Print how a pass failed, and write a reproducer."""
        self.report()
        show_fault(error, self.name, self.options.reproducers)

    def _dump(self, step: str, document: str) -> None:
        print_text(f"// {self.name} after {step}\n{document}", err=True)

    def _print(self, text: str) -> None:
        print_text(f"{self.name}: {text}", err=True)


def show_fault(error: PassError, name: str, folder: Path | None = None) -> None:
    """Print how a pass failed on the input that messages call `name`, and write a reproducer into a folder."""
    from twinform.compiler.reproducers import write_reproducer  # noqa: PLC0415 - passes seldom fail

    print_line(f"{name}: {error}", err=True)
    try:
        path = write_reproducer(error, name, folder)
    except (OSError, TypeError, ValueError) as problem:
        reason = problem.strerror if isinstance(problem, OSError) else problem
        print_line(f"    nothing could be written that makes it come again: {reason}", err=True)
    else:
        print_line(f"    to see it again: twinform reproduce {path}", err=True)


def end_with(error: Exception, ctx: click.Context) -> None:
    """End the command if the exception is that of a pass that failed; return for any other exception."""
    if isinstance(error, PassError):
        show_fault(error, f"twinform {ctx.invoked_subcommand}")
        ctx.exit(UNUSABLE)


@contextmanager
def mesh_progress(passes: Iterable[Pass]) -> Generator[None]:
    """Show which mesh the passes work on, if stderr is a terminal and rich is installed."""
    if not (sys.stderr.isatty() and any(isinstance(step, FilesPass) for step in passes) and find_spec("rich")):
        yield
        return
    from rich.console import Console  # noqa: PLC0415 - scripts do without
    from rich.markup import escape  # noqa: PLC0415 - as above

    from twinform.passes.meshes.mesh_pass import watched_by  # noqa: PLC0415 - few runs have meshes

    with Console(stderr=True).status("passes") as status:

        def show(uri: str | None) -> None:
            if uri is not None:
                status.update(escape(f"mesh {printable(uri)}"))

        with watched_by(show):
            yield
