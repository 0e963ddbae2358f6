"""How the files of a command are read: options that several commands share, and the arguments of xacro."""

import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from twinform.cli.config import config_options, settings_of
from twinform.cli.files import Exclusion, NothingFoundError, PatternError, discover
from twinform.cli.files.model_files import FileKind, is_model
from twinform.cli.flags import flag, flags_of, group
from twinform.cli.source import InputSource, open_source
from twinform.compiler import LoadOptions
from twinform.compiler.input.load_options import FileOptions, ReadingOptions
from twinform.compiler.input.size_limits import LARGEST
from twinform.compiler.option import declared_options
from twinform.diagnostics import Policy

if TYPE_CHECKING:
    from twinform.profiles import Profile

Command = TypeVar("Command", bound=Callable[..., Any])


_ARGUMENT = re.compile(r"(?P<name>[A-Za-z_][\w.-]*):=(?P<value>.*)", re.DOTALL)
_FOLDER = {"type": click.Path(exists=True, file_okay=False, path_type=Path)}
_file_flags = group("reading", dict, *flags_of(FileOptions, paths=_FOLDER))
_reading_flags = group("reading", dict, *flags_of(ReadingOptions, paths=_FOLDER))
size_option = flag("max_size", *declared_options(FileOptions)["max_size"])


def file_options(command: Command) -> Command:
    """Give a command the options that say how a file is read, as `reading`, and the settings of the project."""
    return config_options(_file_flags(command))


def reading_options(command: Command) -> Command:
    """Add the flags of reading to a command, and those about the files that are included."""
    return config_options(_reading_flags(command))


def load_options_of(
    arguments: Mapping[str, str],
    options: FileOptions,
    policy: Policy | None = None,
    profiles: "tuple[Profile, ...]" = (),
) -> LoadOptions:
    """The options as the compiler takes them; the folders of the project come after those of the command line.

    Where there is a policy, what it allows is left out, errors too. `profiles` are those of the consumers.
    """
    project = settings_of(click.get_current_context())
    given: FileOptions = {
        **options,
        "paths": (*options.get("paths", ()), *project.folders),
        "env": (*options.get("env", ()), *project.variables),
        "arguments": arguments,
    }
    allow = policy.allow if policy else ()
    return LoadOptions.of(given, allow=allow, profiles=profiles, tolerant=policy is not None)


def inputs(words: Sequence[str]) -> tuple[list[InputSource], dict[str, str]]:
    """The files among the arguments of a command line, and the `name:=value` arguments for those that are xacro.

    Raises:
        click.UsageError: there are no files, or arguments that nothing takes.
    """
    files, arguments = _split(words)
    return _opened(files, arguments), arguments


def model_inputs(
    words: Sequence[str], exclusion: Exclusion, kind: FileKind = is_model
) -> tuple[list[InputSource], dict[str, str]]:
    """Open the model files that a command line names, also by folders and globs, without what is excluded.

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


def _opened(files: Sequence[str], arguments: Mapping[str, str]) -> list[InputSource]:
    ctx = click.get_current_context(silent=True)
    xacro = bool(ctx and ctx.params.get("xacro"))
    if arguments and not (xacro or any(file.lower().endswith(".xacro") for file in files)):
        raise click.UsageError(f"{next(iter(arguments))}:=... is an argument of xacro, and no input is a .xacro file")
    size = (ctx and ctx.params.get("max_size")) or LARGEST
    return [open_source(file, size) for file in files]
