"""How the files of a command are read: options that several commands share, and the arguments of xacro."""

import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict, TypeVar

import click

from twinform.cli.config import config_options, hold_limit, settings_of
from twinform.cli.files import Exclusion, NothingFoundError, PatternError, discover
from twinform.cli.files.model_files import Kind, is_model
from twinform.cli.source import Source, open_source
from twinform.compiler import LoadOptions, SearchPath
from twinform.compiler.input.limits import LARGEST, MOST_TAGS, Limits, parse_size
from twinform.diagnostics import Policy
from twinform.schemas import Engine

if TYPE_CHECKING:
    from twinform.profiles import Profile

Command = TypeVar("Command", bound=Callable[..., Any])


def _size(ctx: click.Context, option: click.Parameter, value: str) -> int:
    try:
        size = parse_size(value)
    except ValueError as error:
        raise click.BadParameter(str(error)) from error
    return hold_limit(ctx, option, size, LARGEST)


def _tags(ctx: click.Context, option: click.Parameter, value: int) -> int:
    return hold_limit(ctx, option, value, MOST_TAGS)


_ARGUMENT = re.compile(r"(?P<name>[A-Za-z_][\w.-]*):=(?P<value>.*)", re.DOTALL)
size_option = click.option(
    "--max-size",
    metavar="SIZE",
    default=str(LARGEST),
    callback=_size,
    help="The largest file that is read, such as 200MB or 1GiB; by default 64MiB.",
)
_OPTIONS = (
    click.option("--strict/--no-strict", default=False, help="Refuse what readers ignore, such as unknown names."),
    click.option(
        "--engine",
        type=click.Choice(["libxml2", "xmlschema"]),
        default="libxml2",
        help="The XSD validator; xmlschema is the slow reference.",
    ),
    click.option(
        "--path",
        "paths",
        metavar="DIR",
        multiple=True,
        type=click.Path(exists=True, file_okay=False, path_type=Path),
        help="A folder of models or packages, looked in before those that the environment names; repeatable.",
    ),
    click.option(
        "--env",
        metavar="NAME",
        multiple=True,
        help="An environment variable that xacro files may read besides those of ROS and Gazebo; * fits any letters.",
    ),
    click.option(
        "--xacro/--no-xacro",
        default=None,
        help="Expand all files, or none; by default those called .xacro. It evaluates expressions in them.",
    ),
    size_option,
    click.option(
        "--max-tags",
        type=click.IntRange(min=1),
        metavar="N",
        default=MOST_TAGS,
        callback=_tags,
        help=f"The most tags of a file, or parts of a JSON document; by default {MOST_TAGS:,}.",
    ),
)
_EXPAND_INCLUDES = click.option(
    "--expand-includes", is_flag=True, help="Read the files that includes name, and put them in their place."
)


def file_options(command: Command) -> Command:
    """Give a command the options that say how a file is read, and the settings of the project."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return config_options(command)


def reading_options(command: Command) -> Command:
    """The same, and whether the files that it includes are read too."""
    return file_options(_EXPAND_INCLUDES(command))


class InputOptions(TypedDict):
    """What these options give a command."""

    strict: bool
    engine: Engine
    paths: tuple[Path, ...]
    env: tuple[str, ...]
    xacro: bool | None
    max_size: int
    max_tags: int


def load_options_of(
    arguments: Mapping[str, str],
    input_options: InputOptions,
    policy: Policy | None = None,
    profiles: "tuple[Profile, ...]" = (),
) -> LoadOptions:
    """The options as the compiler takes them; the folders of the project come after those of the command line.

    Where there is a policy, what it allows is left out, errors too. `profiles` are those of the consumers.
    """
    project = settings_of(click.get_current_context())
    paths = (*input_options["paths"], *project.folders)
    return LoadOptions(
        input_options["strict"],
        input_options["engine"],
        SearchPath.of(paths),
        arguments,
        input_options["xacro"],
        Limits(input_options["max_size"], input_options["max_tags"]),
        allow=policy.allow if policy else frozenset(),
        tolerant=policy is not None,
        profiles=profiles,
        variables=(*input_options["env"], *project.variables),
    )


def inputs(words: Sequence[str]) -> tuple[list[Source], dict[str, str]]:
    """The files among the arguments of a command line, and the `name:=value` arguments for those that are xacro.

    Raises:
        click.UsageError: there are no files, or arguments that nothing takes.
    """
    files, arguments = _split(words)
    return _opened(files, arguments), arguments


def model_inputs(
    words: Sequence[str], exclusion: Exclusion, kind: Kind = is_model
) -> tuple[list[Source], dict[str, str]]:
    """The same, where the files may be folders and globs too: all of a kind that the exclusion leaves.

    Raises:
        click.UsageError: as above, or there is no model.
    """
    files, arguments = _split(words)
    try:
        return _opened(discover(files, exclusion, kind), arguments), arguments
    except (NothingFoundError, PatternError) as error:
        raise click.UsageError(str(error)) from error


def _split(words: Sequence[str]) -> tuple[list[str], dict[str, str]]:
    matches = [_ARGUMENT.fullmatch(word) for word in words]
    arguments = {match["name"]: match["value"] for match in matches if match}
    files = [word for word, match in zip(words, matches, strict=True) if not match]
    if not files:
        raise click.UsageError("there are arguments of xacro and no input")
    return files, arguments


def _opened(files: Sequence[str], arguments: Mapping[str, str]) -> list[Source]:
    ctx = click.get_current_context(silent=True)
    xacro = bool(ctx and ctx.params.get("xacro"))
    if arguments and not (xacro or any(file.lower().endswith(".xacro") for file in files)):
        raise click.UsageError(f"{next(iter(arguments))}:=... is an argument of xacro, and no input is a .xacro file")
    size = int(ctx.params["max_size"]) if ctx and "max_size" in ctx.params else LARGEST
    return [open_source(file, size) for file in files]
