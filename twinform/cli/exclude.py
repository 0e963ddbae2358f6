"""`--exclude` and `--force-exclude`."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import click

from twinform.cli.config import settings_of
from twinform.cli.files import DEFAULT_EXCLUDE, Exclusion

Command = TypeVar("Command", bound=Callable[..., Any])


def exclude_options(command: Command) -> Command:
    """Give a command `--exclude PATTERN` and `--force-exclude`."""
    command = click.option(
        "--force-exclude",
        is_flag=True,
        help="Leave excluded files, and those that only have macros, out even where they are named, as hooks do.",
    )(command)
    return click.option(
        "--exclude",
        metavar="PATTERN",
        multiple=True,
        help="Leave out what fits in folders, in the notation of .gitignore; repeatable, and added to what the "
        "configuration has.",
    )(command)


def exclusion_of(ctx: click.Context, patterns: Sequence[str], *, force: bool) -> Exclusion:
    """What is left out: what the project says, or usual folders, and the patterns of the command line."""
    project = settings_of(ctx)
    configured = DEFAULT_EXCLUDE if project.exclude is None else project.exclude
    folder = project.path.parent if project.path else Path()
    return Exclusion((*configured, *project.extend_exclude, *patterns), folder, force)
