"""The command line: one file for each command, imported when it is called."""

import signal
import threading
from collections.abc import Generator, Mapping
from contextlib import contextmanager
from importlib import import_module
from typing import Any

import click

from twinform import __version__
from twinform.cli.process import end_unwritable, hold_standard_streams, quiet_when_unread
from twinform.signals import raise_exit

COMMANDS: Mapping[str, str] = {
    "convert": "Compile robot models from one format into the other.",
    "check": "Find everything that is wrong with robot models.",
    "fix": "Fix robot models in their files, and run passes on them.",
    "diff": "Say whether two files describe the same robot.",
    "sync": "Let the files of one robot follow one that is their source.",
    "merge": "Merge the edits of two people in a model file.",
    "format": "Format the text of models, and change nothing else.",
    "advise": "Say which format to keep a robot in, and who takes it.",
    "stats": "Print in numbers what models are made of.",
    "view": "Show a robot or world in a browser, or two overlaid.",
    "report": "Write a report on a model, or on two, that opens offline.",
    "graph": "Draw the links and joints of a model or world.",
    "package": "Put a model and all its files into a folder.",
    "batch": "Work on every model of a folder, on several processors or machines.",
    "fuel": "Fill the local cache of Gazebo Fuel.",
    "reproduce": "Run a pass again that failed.",
    "passes": "List the passes, or print the page of one.",
    "explain": "Print the page of a rule, or who reads a feature; list all rules.",
    "schema": "Print the schema of URDF, SDF, MJCF, JSON or the configuration.",
    "clean": "Delete the results of earlier runs of check and format.",
    "lsp": "Be the language server of an editor.",
    "mcp": "Serve agents and scripts by the Model Context Protocol.",
}
"""Every command and its summary, which the help shows without importing the command.

The command is the name `command` in the module of the same name.
"""


@contextmanager
def _printed_errors() -> Generator[None]:
    """Print the errors of the command line safely, which click would print as they are, and end with their code."""
    with quiet_when_unread():  # click would end with another exit code
        try:
            yield
        except click.ClickException as error:
            from twinform.cli.printing import print_error  # noqa: PLC0415 - it seldom happens

            print_error(error)
            raise click.exceptions.Exit(error.exit_code) from error


class _Commands(click.Group):
    """Imports a command when it is called: the compiler takes ten times as long to import as this module."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names in the order of the help."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import a command."""
        return getattr(import_module(f"{__name__}.{cmd_name}"), "command", None) if cmd_name in COMMANDS else None

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that is called; the error for one that does not exist suggests another."""
        try:
            return super().resolve_command(ctx, args)
        except click.UsageError as error:
            from twinform.diagnostics.did_you_mean import did_you_mean  # noqa: PLC0415 - it seldom happens

            hint = did_you_mean(args[0], COMMANDS)
            raise click.UsageError(
                f"{error.message} {hint.capitalize()}" if hint else error.message, error.ctx
            ) from None

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Print the summaries, without importing any command."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def main(self, *args: Any, **extra: Any) -> Any:
        """Run the command line; SIGTERM ends it as Ctrl-C does, after cleaning up."""
        if threading.current_thread() is threading.main_thread() and signal.getsignal(signal.SIGTERM) is signal.SIG_DFL:
            signal.signal(signal.SIGTERM, raise_exit)
        hold_standard_streams()
        try:
            with quiet_when_unread():
                return super().main(*args, **extra)
        except OSError as error:
            end_unwritable(error)

    def make_context(self, *args: Any, **extra: Any) -> click.Context:
        """Parse the options before the command, and print errors in them safely."""
        with _printed_errors():
            return super().make_context(*args, **extra)

    def invoke(self, ctx: click.Context) -> object:
        """Run the command; a fault of a pass that it does not expect ends it with a message."""
        try:
            with _printed_errors():
                return super().invoke(ctx)
        except KeyboardInterrupt:
            from twinform.cli.command import INTERRUPTED  # noqa: PLC0415 - it seldom happens

            raise SystemExit(INTERRUPTED) from None
        except (click.ClickException, click.exceptions.Exit, click.Abort, OSError):
            raise
        except Exception as error:
            from twinform.cli.instrumentation import end_with  # noqa: PLC0415 - it seldom happens

            end_with(error, ctx)
            raise


def _print_cmake_folder(ctx: click.Context, _parameter: click.Parameter, value: object) -> None:
    if value:
        from twinform.cli.printing import print_document  # noqa: PLC0415 - build systems alone ask for it
        from twinform.package_files import package_files  # noqa: PLC0415 - as above

        print_document(f"{package_files('twinform').joinpath('cmake')}\n")
        ctx.exit()


@click.command(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, prog_name="twinform")
@click.option(
    "--cmake-dir",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_print_cmake_folder,
    help="Print the folder of the CMake package, for twinform_DIR, and exit.",
)
def main() -> None:
    """Compile robot models between URDF, SDF and MJCF: strict, lossless, all ways."""
