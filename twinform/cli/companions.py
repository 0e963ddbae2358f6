"""What `twinform convert` writes beside the model: a world around it, and the configuration of ros_gz_bridge."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar, get_args

import click

from twinform.cli.failure import Unusable
from twinform.cli.findings import show
from twinform.compiler import Conversion, write_atomically
from twinform.diagnostics import Notes
from twinform.diagnostics.reporters import Findings
from twinform.passes.plugins.parts import ReleaseName

_KEY = "twinform.companions."
"""Where the context keeps what was asked for: the options belong here, and no command has to pass them on."""
_WORLD = "default"
"""The name of the world that is written."""

Command = TypeVar("Command", bound=Callable[..., Any])


def _keep(ctx: click.Context, option: click.Parameter, value: object) -> None:
    ctx.meta[_KEY + str(option.name)] = value


def companion_options(command: Command) -> Command:
    """The options for files beside the model."""
    path = click.Path(path_type=Path)
    names = click.Choice(get_args(ReleaseName))
    text = "Write the file of ros_gz_bridge for the topics of the result."
    command = click.option("--bridge", type=path, metavar="FILE", expose_value=False, callback=_keep, help=text)(
        command
    )
    text = "Write a world with the model in it, ground, light, and the systems that its sensors need."
    command = click.option("--world", type=path, metavar="FILE", expose_value=False, callback=_keep, help=text)(command)
    text = "The release of Gazebo that --bridge and --world are for."
    return click.option("--gazebo", type=names, default="harmonic", expose_value=False, callback=_keep, help=text)(
        command
    )


def write_companions(conversion: Conversion, name: str, *, notes: bool) -> bool:
    """Write what was asked for beside the model; whether it could be made."""
    asked = click.get_current_context().meta
    bridge: Path | None = asked.get(f"{_KEY}bridge")
    world: Path | None = asked.get(f"{_KEY}world")
    if bridge is None and world is None:
        return True
    from twinform.compiler.companions import bridge_text, world_text  # noqa: PLC0415 - most conversions do not need it

    release, found = str(asked[f"{_KEY}gazebo"]), Notes(file=name)
    if world is not None:
        _write(world, world_text(conversion.document, release, found, _WORLD), found)
    if bridge is not None:
        _write(bridge, bridge_text(conversion.document, release, found, _WORLD if world else None), found)
    show(Findings(name, tuple(found.diagnostics)), notes=notes, on_stderr=True)
    return not found.has_errors


def _write(path: Path, text: str, found: Notes) -> None:
    if found.has_errors:
        return
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(path, text)
    except OSError as error:
        raise Unusable(f"cannot write {error.filename or path}: {error.strerror}") from error
