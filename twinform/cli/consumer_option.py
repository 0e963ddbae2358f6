"""`--for`: the consumers that files are for."""

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

import click
from click.core import ParameterSource
from click.shell_completion import CompletionItem

if TYPE_CHECKING:
    from twinform.profiles import Profile

Command = TypeVar("Command", bound=Callable[..., Any])


def _profiles(ctx: click.Context, option: click.Parameter, value: str | None) -> "tuple[Profile, ...]":
    """The profiles of the names. Where none is asked for, nothing of profiles is imported.

    Those of a configuration are not asked for by name: what they do not read is not for them.
    """
    if not value:
        return ()
    from twinform.profiles import UnknownProfileError, parse  # noqa: PLC0415 - see above

    try:
        configured = ctx.get_parameter_source(option.name or "") is ParameterSource.DEFAULT_MAP
        return tuple(replace(each, named=each.named and not configured) for each in parse(value))
    except UnknownProfileError as error:
        raise click.BadParameter(str(error)) from error


def _names(_ctx: click.Context, _option: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """The names that a list may go on with."""
    from twinform.profiles import names  # noqa: PLC0415 - only a shell that completes needs them

    before, comma, begun = incomplete.rpartition(",")
    return [CompletionItem(f"{before}{comma}{name}") for name in names() if name.startswith(begun)]


def consumers_option(command: Command) -> Command:
    """Give a command `--for`."""
    return click.option(
        "--for",
        "profiles",
        metavar="NAME,...",
        callback=_profiles,
        shell_complete=_names,
        help="Who reads the files, such as drake,mujoco, gazebo@harmonic, or portable for all.",
    )(command)


keep_physics_option = click.option(
    "--keep-physics", is_flag=True, help="With --for: refuse passes that change masses, inertias, joints or limits."
)
