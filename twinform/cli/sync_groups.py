"""The groups of files that `twinform sync` keeps the same: those of the command line, or of the table `[sync]`."""

import os
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import click

from twinform.cli.inputs import InputSource, format_of_suffix
from twinform.compiler.input.load_options import XACRO
from twinform.request_options import Language
from twinform.storage.writing import identities, is_stream

_MARK = "@"
"""Stands before the name of a group, as before that of a pipeline."""


class SyncGroup(NamedTuple):
    """The files of one robot: its name in the configuration, the source, and the files that are made of it."""

    name: str
    source: Path
    others: tuple[Path, ...]


def groups_of(words: Sequence[str], source: Path | None, configured: Mapping[str, Sequence[Path]]) -> list[SyncGroup]:
    """Return the groups that words mean: files, names of groups with @ before them, or nothing for all groups.

    Raises:
        click.UsageError: there is no such group, the words contradict each other, or a file is in two places.
    """
    named = {name: [_shown(each) for each in files] for name, files in configured.items()}
    if source is not None and len(words) == 0:
        raise click.UsageError("--source is for one robot: name the other files, or its group as @NAME")
    names = [word.removeprefix(_MARK) for word in words if word.startswith(_MARK)]
    if names and (len(names) < len(words) or (source and len(names) > 1)):
        raise click.UsageError("name groups as @NAME or files, and --source for one robot only")
    if not words or names:
        found = [_group(name, _known(name, named), source) for name in names or _all_names(named)]
    else:
        found = [_group_of_files([Path(word) for word in words], source, named)]
    _require_apart(found)
    return found


def _all_names(named: Mapping[str, Sequence[Path]]) -> Iterable[str]:
    if not named:
        raise click.UsageError("name two or more files of a robot, or give twinform.toml a table [sync]")
    return named


def _known(name: str, named: Mapping[str, Sequence[Path]]) -> Sequence[Path]:
    if name not in named:
        from twinform.diagnostics.did_you_mean import did_you_mean  # noqa: PLC0415 - it seldom happens

        hint = did_you_mean(name, named)
        raise click.UsageError(f"the table [sync] has no group {name}{f'; {hint}' if hint else ''}")
    return named[name]


def _group(name: str, files: Sequence[Path], source: Path | None) -> SyncGroup:
    """Make a group, whose source is the first file unless another one is named."""
    first = files[0] if source is None else source
    own = set(identities(first))
    others = tuple(each for each in files if own.isdisjoint(identities(each)))
    if len(files) - len(others) > 1:
        raise click.UsageError(f"{first} is there twice")
    if not others:
        raise click.UsageError(f"{first} is the only file: name those that are made of it too")
    return SyncGroup(name, first, others)


def _group_of_files(files: list[Path], source: Path | None, named: Mapping[str, Sequence[Path]]) -> SyncGroup:
    """Make a group of files that were named; one that is in the configuration has the source that stands there."""
    wanted = [{*identities(each)} for each in files]
    for name, group in named.items():
        inside = [{*identities(each)} for each in group]
        if all(any(one & other for other in inside) for one in wanted):
            if len(files) == 1 and source is None:
                return _group(name, group, None)
            return _group(name, files, source or _source_among(files, group))
    if len(files) == 1 and source is None:
        raise click.UsageError(f"{files[0]} is one file: name the others too, or put it into a group of [sync]")
    return _group("", files, source)


def _source_among(files: Sequence[Path], group: Sequence[Path]) -> Path | None:
    """Return the source of a group where it is among some of its files."""
    own = set(identities(group[0]))
    return next((each for each in files if not own.isdisjoint(identities(each))), None)


def _require_apart(groups: Sequence[SyncGroup]) -> None:
    """Require that each file is made once, and is no source.

    Raises:
        click.UsageError: a file is in two places.
    """
    sources: set[Hashable] = {key for group in groups for key in identities(group.source)}
    made: set[Hashable] = set()
    for file in (file for group in groups for file in group.others):
        keys = {*identities(file)}
        if keys & sources:
            raise click.UsageError(f"{file} is the source of one group, and made in another one: make them one group")
        if keys & made:
            raise click.UsageError(f"{file} is there twice")
        made |= keys


def _shown(path: Path) -> Path:
    """Return a path as it is seen from the current folder, if it is below that."""
    folder = Path.cwd()
    own = Path(os.path.abspath(path))  # noqa: PTH100 - links stay links
    return own.relative_to(folder) if own.is_relative_to(folder) else own


def target_format(file: Path, source: Path) -> Language:
    """Return the format of a file that is to be made of a source: by its content, or else by its suffix.

    Raises:
        click.UsageError: it is no file of a robot, or none that can be written.
    """
    if str(file).lower().endswith(XACRO):
        raise click.UsageError(f"{file} is xacro, which is never written: make it the source, with --source")
    if is_stream(file) or file.is_dir():
        raise click.UsageError(f"{file} is no file")
    found = InputSource(str(file), str(file)).format if file.exists() else format_of_suffix(file.name)
    if found is None and file.suffix.lower() == ".xml":
        found = "mjcf"
    for language in _written():
        if found == language:
            return language
    raise click.UsageError(f"{file} is no URDF, SDF or MJCF, so it cannot be made of {source}")


def _written() -> Iterator[Language]:
    yield "urdf"
    yield "sdf"
    yield "mjcf"
