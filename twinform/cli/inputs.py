"""The input files of a command: which models are meant by files, folders and globs, and how they are read."""

import os
import re
import stat
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from twinform.cli.command import combine_options
from twinform.cli.config_defaults import config_options, counts_for_all, settings_of
from twinform.cli.config_file import ConfigError
from twinform.cli.flags import flag, flags_of, group
from twinform.cli.model_files import (
    DEFAULT_EXCLUDE,
    Exclusion,
    FileKind,
    FolderExclusion,
    PatternError,
    is_model,
)
from twinform.cli.nearest_projects import NearestProjects
from twinform.compiler.input.load_options import XACRO, FileOptions, LoadOptions, ReadingOptions
from twinform.compiler.input.root_names import ENOUGH, FORMATS, root_name
from twinform.compiler.input.size_limits import LARGEST
from twinform.diagnostics import Policy
from twinform.file_access import STREAMS, Readable, read_up_to
from twinform.lazy import lazy_pattern
from twinform.option import declared_options

if TYPE_CHECKING:
    from twinform.cli.config_defaults import Project
    from twinform.cli.path_patterns import FolderWalk
    from twinform.compiler import LoadResult
    from twinform.profiles import Profile


_FORMATS = {b"robot": "urdf", b"sdf": "sdf", b"mujoco": "mjcf"}
_STDIN = "<stdin>"

Remember = Callable[[object, Callable[[], list[str]]], list[str]]
"""Returns what a function returns for a key, perhaps from an earlier run."""


class InputSource(NamedTuple):
    """The path of a file or the bytes of a stream, and the name that messages use."""

    content: str | bytes
    name: str

    @property
    def path(self) -> Path:
        """The file; standard input may be one too, which the shell has opened."""
        return Path("/dev/stdin" if self.name == _STDIN else self.name)

    @property
    def format(self) -> str | None:
        """The format by the beginning of the content, or else by the suffix; None if neither tells."""
        head = self.content[:ENOUGH] if isinstance(self.content, bytes) else _head(Path(self.content))
        if head.lstrip()[:1] == b"{":
            return "json"
        return _FORMATS.get(root_name(head)) or format_of_suffix(self.name)


def open_source(argument: str, size: int = LARGEST, stdin_name: str | None = None) -> InputSource:
    """Open the source that an argument names; a stream is read, up to a few bytes more than `size`."""
    if argument == "-":
        return InputSource(read_up_to(sys.stdin.buffer, size), stdin_name or _STDIN)
    if _is_stream(argument):
        with Path(argument).open("rb") as pipe:
            return InputSource(read_up_to(pipe, size), argument)
    return InputSource(argument, argument)


def _is_stream(argument: str) -> bool:
    """Whether an argument is a pipe or device named as such, like `/dev/stdin` or `<(xacro robot.urdf.xacro)`."""
    # A pipe of another name may be a trap in somebody's folder, into which nobody ever writes.
    if not argument.startswith(STREAMS):
        return False
    try:
        mode = Path(argument).stat().st_mode
    except (OSError, ValueError):
        return False  # the compiler reports it
    return stat.S_ISFIFO(mode) or stat.S_ISCHR(mode)


def format_of_suffix(name: str) -> str | None:
    """Return the format of a file by its name; `robot.urdf.xacro` is URDF."""
    path = Path(name)
    suffix = path.suffix.lower()
    return FORMATS.get(Path(path.stem).suffix.lower() if suffix == ".xacro" else suffix)


def _head(path: Path) -> bytes:
    try:
        return Readable.of(path).read(path, ENOUGH)[:ENOUGH]
    except (OSError, ValueError):
        return b""  # the compiler reports it


_ARGUMENT = lazy_pattern(r"(?P<name>[A-Za-z_][\w.-]*):=(?P<value>.*)", re.DOTALL)
_FOLDER = {"type": click.Path(exists=True, file_okay=False, path_type=Path)}
file_options = combine_options(config_options, group("reading", dict, *flags_of(FileOptions, paths=_FOLDER)))
"""Gives a command the options of how a file is read, as `reading`, and those of the configuration."""
reading_options = combine_options(config_options, group("reading", dict, *flags_of(ReadingOptions, paths=_FOLDER)))
"""Gives a command `file_options`, and the options of how included files are read."""
size_option = flag("max_size", *declared_options(FileOptions)["max_size"])
exclude_options = combine_options(
    click.option(
        "--exclude",
        metavar="PATTERN",
        multiple=True,
        help="Leave out what fits in folders, in the notation of .gitignore; repeatable, and added to what the "
        "configuration has.",
    ),
    click.option(
        "--force-exclude",
        is_flag=True,
        help="Leave excluded files, and those that only have macros, out even where they are named, as hooks do.",
    ),
)
"""Gives a command `--exclude PATTERN` and `--force-exclude`."""


def read_model(source: InputSource, load_options: LoadOptions, options: ReadingOptions) -> "LoadResult":
    """Read a source, and expand its includes if the options ask for that."""
    from twinform.compiler import read  # noqa: PLC0415 - a formatter reads text alone

    loaded = read(source.content, load_options, name=source.name)
    if not options.get("expand_includes"):
        return loaded
    from twinform.compiler import expand  # noqa: PLC0415 - few runs read other files

    return expand(loaded, load_options)


def load_options_of(
    arguments: Mapping[str, str],
    options: FileOptions,
    policy: Policy | None = None,
    profiles: "tuple[Profile, ...]" = (),
    *,
    project: "Project | None" = None,
) -> LoadOptions:
    """Make the compiler's options of those of a command; folders of the project come after those that are typed.

    With a policy, the findings that it allows are left out, errors too. `profiles` are those of the consumers. The
    project is that of the current folder unless another one is given.
    """
    project = project or settings_of(click.get_current_context())
    given: FileOptions = {
        **options,
        "paths": (*options.get("paths", ()), *project.folders),
        "env": (*options.get("env", ()), *project.variables),
        "arguments": arguments,
    }
    allow = policy.allow if policy else ()
    return LoadOptions.of(given, allow=allow, profiles=profiles, tolerant=policy is not None)


def inputs(words: Sequence[str]) -> tuple[list[InputSource], dict[str, str]]:
    """Open the files among the arguments of a command line, and parse the `name:=value` arguments of xacro.

    Raises:
        click.UsageError: there are no files, or arguments of xacro without a xacro file.
    """
    files, arguments = split_words(words)
    return _open_files(files, arguments), arguments


def model_inputs(
    words: Sequence[str],
    exclusion: Exclusion,
    kind: FileKind = is_model,
    remember: Remember = lambda _, make: make(),
    *,
    stdin_name: str | None = None,
) -> tuple[list[InputSource], dict[str, str]]:
    """Open the model files that a command line names, also by folders and globs, without what is excluded.

    `remember` may know from an earlier run which these are. `stdin_name` is the name for the text of standard input.

    Raises:
        click.UsageError: as `inputs`, or there is no model.
    """
    files, arguments = split_words(words)
    try:
        key = ("files", files, exclusion, getattr(kind, "__name__", ""))
        found = remember(key, lambda: discover(files, exclusion, kind))
        return _open_files(found, arguments, stdin_name), arguments
    except (NothingFoundError, PatternError) as error:
        raise click.UsageError(str(error)) from error


def split_words(words: Sequence[str]) -> tuple[list[str], dict[str, str]]:
    """Split a command line into files and `name:=value` arguments of xacro.

    Raises:
        click.UsageError: there are no files.
    """
    matches = [_ARGUMENT.fullmatch(word) for word in words]
    arguments = {match["name"]: match["value"] for match in matches if match}
    files = [word for word, match in zip(words, matches, strict=True) if not match]
    if not files:
        raise click.UsageError("there are arguments of xacro and no input")
    return files, arguments


def _open_files(files: Sequence[str], arguments: Mapping[str, str], stdin_name: str | None = None) -> list[InputSource]:
    ctx = click.get_current_context(silent=True)
    xacro = bool(ctx and ctx.params.get("xacro"))
    if arguments and not (xacro or any(file.lower().endswith(XACRO) for file in files)):
        raise click.UsageError(f"{next(iter(arguments))}:=... is an argument of xacro, and no input is a .xacro file")
    size = (ctx and ctx.params.get("max_size")) or LARGEST
    return [open_source(file, size, stdin_name) for file in files]


def exclusion_of(ctx: click.Context, patterns: Sequence[str], *, force: bool) -> Exclusion:
    """Combine the exclusion of each folder's project, or the default one, with the patterns of the command line."""
    own = settings_of(ctx)

    def in_folder(folder: str) -> Exclusion | None:
        try:
            project = projects.in_folder(Path(os.path.abspath(folder)))  # noqa: PTH100 - links stay links
        except ConfigError:
            return None  # it is reported with the files of the folder
        return of(project) if project and project.path != own.path else None

    def of(project: "Project", in_folder: FolderExclusion | None = None) -> Exclusion:
        configured = DEFAULT_EXCLUDE if project.exclude is None else project.exclude
        folder = project.path.parent if project.path else Path()
        return Exclusion((*configured, *project.extend_exclude, *patterns), folder, force, in_folder)

    projects = NearestProjects()
    return of(own, None if counts_for_all(ctx) else in_folder)


_MAGIC = frozenset("*?[")


class NothingFoundError(ValueError):
    """A folder or pattern leads to no model."""


def discover(words: Sequence[str], exclusion: Exclusion, kind: FileKind = is_model) -> list[str]:
    """Find the files that words mean: files, folders with files of a kind, and globs.

    Named files are always found, unless the exclusion is enforced. A folder that cannot be listed is returned like a
    file, so that reading it reports why.

    Raises:
        NothingFoundError: there is no model in a folder, or none that fits a glob.
        PatternError: a pattern of the exclusion is invalid.
    """
    found: dict[str, str] = {}
    for word in words:
        for name in _find(word, exclusion, kind):
            found.setdefault(name if name == "-" else os.path.abspath(name), name)  # noqa: PTH100 - links stay links
    return list(found.values())


def _find(word: str, exclusion: Exclusion, kind: FileKind) -> Iterator[str]:
    if os.path.isdir(word):  # noqa: PTH112 - Path.is_dir raises where a name is too long
        if not (exclusion.force and _is_excluded(word, exclusion, is_folder=True)):
            yield from _find_below(word, exclusion, kind)
    elif _MAGIC & set(word) and not os.path.lexists(word):
        yield from _find_fitting(word, exclusion, kind)
    elif word == "-" or not (exclusion.force and _is_unwanted(word, exclusion, kind)):
        yield word


def _is_unwanted(word: str, exclusion: Exclusion, kind: FileKind) -> bool:
    """Whether a named file is excluded, or only has macros for others."""
    is_part = word.lower().endswith(XACRO) and not kind(Path(word))
    return is_part or _is_excluded(word, exclusion)


def _is_excluded(word: str, exclusion: Exclusion, *, is_folder: bool = False) -> bool:
    from twinform.cli.path_patterns import PathPatterns  # noqa: PLC0415 - most runs enforce no exclusion

    exclusion = exclusion.of_folder(os.path.dirname(word) or ".")  # noqa: PTH120 - a folder beside it has none
    patterns = PathPatterns.of(exclusion.folder, exclusion.patterns)
    return patterns.match(os.path.abspath(word), is_folder=is_folder)  # noqa: PTH100 - links stay links


def _find_below(folder: str, exclusion: Exclusion, kind: FileKind) -> list[str]:
    from twinform.cli.path_patterns import FolderWalk  # noqa: PLC0415 - most runs name their files

    return _walk(FolderWalk(folder, exclusion, kind=kind), f"there is no model in {folder}")


def _find_fitting(pattern: str, exclusion: Exclusion, kind: FileKind) -> list[str]:
    """Find the files that fit a glob, below the last folder that it names without a wildcard."""
    from twinform.cli.path_patterns import FolderWalk, PathPatterns  # noqa: PLC0415 - as above

    parts = Path(pattern).parts
    fixed = next(place for place, part in enumerate(parts) if _MAGIC & set(part))
    top = os.path.join(*parts[:fixed]) if fixed else "."  # noqa: PTH118 - `.` stays
    wanted = PathPatterns.of(top, [f"/{'/'.join(parts[fixed:])}"])
    return _walk(
        FolderWalk(top, exclusion, wanted, named=not set(parts[-1]) <= {"*"}, kind=kind), f"no model fits {pattern}"
    )


def _walk(walk: "FolderWalk", problem: str) -> list[str]:
    """Walk through a folder, and raise `NothingFoundError` if nothing is found."""
    found = sorted(walk.run())
    if not found:
        what = f"; {walk.left_out} are excluded or ignored by git" if walk.left_out else ""
        raise NothingFoundError(f"{problem}{what}")
    return found
