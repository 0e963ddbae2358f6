"""A group of commands that are imported when they are called: one file for each, with the name `command` in it."""

from collections.abc import Mapping
from importlib import import_module
from typing import Any

import click


class LazyGroup(click.Group):
    """The commands in the modules of a `package`, by their names; `summaries` has one for each, for the help."""

    def __init__(self, *args: Any, package: str, summaries: Mapping[str, str], **extra: Any) -> None:
        super().__init__(*args, **extra)
        self.package, self.summaries = package, summaries

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Their names, as the help lists them."""
        return list(self.summaries)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import one."""
        if cmd_name not in self.summaries:
            return None
        return getattr(import_module(f"{self.package}.{cmd_name}"), "command", None)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Print the summaries, without importing any."""
        with formatter.section("Commands"):
            formatter.write_dl(list(self.summaries.items()))
