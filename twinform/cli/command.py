"""What the commands are made of: a class with examples, options, exit codes, and one error."""

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import click

FINDINGS = 1
"""Exit code: the files could be read, and there are errors in them."""
UNUSABLE = 2
"""Exit code: a file could not be read or written, or the command line is wrong."""
INTERRUPTED = 130
"""Exit code of a program that is ended by Ctrl-C, as shells give it."""

Decorated = TypeVar("Decorated", bound=Callable[..., Any])
Decorator = Callable[[Any], Any]


class Unusable(click.ClickException):
    """Ends the command with a message and the exit code of wrong usage."""

    exit_code = UNUSABLE


class Command(click.Command):
    """A command whose help ends with `examples`: descriptions, and the command lines that do it."""

    def __init__(self, *args: Any, examples: Mapping[str, str], **extra: Any) -> None:
        super().__init__(*args, **extra)
        self.examples = examples

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Print the examples; their lines are never broken, so that they can be copied."""
        super().format_epilog(ctx, formatter)
        with formatter.section("Examples"):
            for what, typed in self.examples.items():
                formatter.write_text(f"{what}:")
                formatter.write(f"{'':{formatter.current_indent + 2}}{typed}\n")


class LazyGroup(click.Group):
    """A group whose help lists `summaries`; `load` imports the group with the commands when one is called."""

    def __init__(self, *args: Any, summaries: Mapping[str, str], load: Callable[[], click.Group], **extra: Any) -> None:
        super().__init__(*args, **extra)
        self.summaries, self.load = summaries, load

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names in the order of the help."""
        return list(self.summaries)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import a command."""
        return self.load().get_command(ctx, cmd_name)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Print the summaries, without importing any command."""
        with formatter.section("Commands"):
            formatter.write_dl(list(self.summaries.items()))


def combine_options(*options: Decorator) -> Callable[[Decorated], Decorated]:
    """Combine options into one decorator, which gives them to a command in this order."""

    def give(command: Decorated) -> Decorated:
        for option in reversed(options):
            command = option(command)
        return command

    return give
