"""`--config`: the settings of a project become the defaults of options."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import click

from twinform.cli.config.errors import ConfigError
from twinform.cli.config.files import Table, find, section
from twinform.cli.config.pipelines import NamedPipelines
from twinform.cli.config.settings import Settings, parse_settings
from twinform.passes.named import Names, no_names

Command = TypeVar("Command", bound=Callable[..., Any])
_KEY = f"{__name__}.project"
_DEFAULTS = ("sdf_version", "urdf_version", "strict", "carriers", "passes")
"""Settings that are what an option is where the command line says nothing."""


@dataclass(frozen=True, slots=True)
class Project:
    """The settings that are in force, the file that they come from, and the pipelines that it names."""

    settings: Settings
    path: Path | None = None
    names: Names = no_names


def config_options(command: Command) -> Command:
    """Give a command `--config FILE` and `--no-config`."""
    command = click.option(
        "--no-config", is_flag=True, is_eager=True, expose_value=False, callback=_none, help="Use no configuration."
    )(command)
    return click.option(
        "--config",
        type=click.Path(exists=True, dir_okay=False, path_type=Path),
        is_eager=True,
        expose_value=False,
        callback=_load,
        help="The configuration; else the nearest twinform.toml, or pyproject.toml with [tool.twinform].",
    )(command)


def settings_of(ctx: click.Context) -> Project:
    """The project of a command that has these options."""
    found = ctx.meta.get(_KEY)
    return found if isinstance(found, Project) else Project(Settings())


def _section(path: Path) -> Table:
    found = section(path)
    if found is None:
        raise ConfigError(path, "there is no such table")
    return found


def _nearest() -> tuple[Path, Table] | None:
    try:
        return find(Path.cwd())
    except FileNotFoundError:
        return None  # the current folder is gone


def _none(ctx: click.Context, _option: click.Parameter, value: bool) -> None:
    if value:
        ctx.meta[_KEY] = Project(Settings())
        ctx.default_map = {}


def _load(ctx: click.Context, _option: click.Parameter, value: Path | None) -> None:
    if _KEY in ctx.meta:
        if value is not None:
            raise click.UsageError("--config and --no-config contradict each other")
        return
    found = (value, _section(value)) if value is not None else _nearest()
    if found is None:
        return
    path, table = found
    settings = parse_settings(path, table)
    ctx.meta[_KEY] = Project(settings, path, NamedPipelines(path, settings.pipelines))
    given = {name: getattr(settings, name) for name in _DEFAULTS}
    ctx.default_map = {name: value for name, value in given.items() if value is not None}
