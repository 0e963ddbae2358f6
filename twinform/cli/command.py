"""What the commands are made of: a class with examples, options, completion for shells, exit codes, and one error."""

import os
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import click
from click.shell_completion import CompletionItem

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


def files(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete files, which the shell knows."""
    return [CompletionItem(incomplete, type="file")]


def rule_names(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete rules, with what they find."""
    from twinform.diagnostics.rule_registry import rules  # noqa: PLC0415 - it reads entry points

    known = {name: each.rule.finds for name, each in rules().items() if name.startswith(incomplete)}
    return [CompletionItem(name, help=finds.partition(". ")[0]) for name, finds in known.items()]


def pass_names(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete passes."""
    from twinform.passes import registered_passes  # noqa: PLC0415 - it reads entry points

    return [CompletionItem(name) for name in registered_passes() if name.startswith(incomplete)]


def pipelines(ctx: click.Context, parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete the last pass of a pipeline, or a pipeline that the configuration names."""
    from twinform.cli.config import settings_of  # noqa: PLC0415 - few calls complete a pipeline

    before, comma, last = incomplete.rpartition(",")
    if comma and os.environ.get("_TWINFORM_COMPLETE") == "fish_complete":
        return []  # click's script for fish ends a word at a comma
    named = [f"@{name}" for name in settings_of(ctx).pipelines if f"@{name}".startswith(last)]
    names = [*(str(each.value) for each in pass_names(ctx, parameter, last)), *named]
    return [CompletionItem(before + comma + name) for name in names]


def sdf_versions(_ctx: click.Context, _parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Complete versions of SDF."""
    from twinform.schemas import versions_of  # noqa: PLC0415 - it reads the tables

    return [CompletionItem(each) for each in versions_of("sdf") if each.startswith(incomplete)]
