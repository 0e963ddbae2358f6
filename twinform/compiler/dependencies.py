"""What a result depends on: files that were read, listed or looked for, options, and the installed code.

As in git, the size, times and inode of a file are compared first, and digests only if one of these differs. The time of
the last status change counts because nobody can set it: reproducible archives, `rsync -t`, Nix and Bazel give files of
different content the same modification time, often with the same size.

A file that was written shortly before it was read may have changed again within one tick of a clock, ours or that of a
file server. Its status proves nothing, so its digest is compared each time.
"""

import os
import stat
import sys
import sysconfig
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass
from enum import StrEnum
from functools import cache
from importlib.metadata import version
from itertools import islice
from pathlib import Path
from posixpath import normpath
from types import MappingProxyType
from typing import Any, NamedTuple, cast

from twinform.compiler.observing import Observation, describe_name, digest, is_coarse, is_young
from twinform.file_access import read_regular
from twinform.passes import Pipeline, registered_passes

_MOST_NAMES = 100_000
"""Entries of a folder; one with more is always listed again."""
Status = Callable[[str], os.stat_result | None]
"""The status of a path; None where nothing is there."""


class DependencyKind(StrEnum):
    """What was found at a path, or what was done with it."""

    ABSENT = "absent"
    READ = "read"
    LISTED = "listed"
    FOLDER = "folder"
    FILE = "file"
    """It was only looked at."""
    OTHER = "other"
    """A pipe, device or socket."""
    NAMED = "named"
    """It was looked at without following a link; the digest says what stood there."""


class Dependency(NamedTuple):
    """A path, relative to the folder of the models if it is inside, and what was there.

    `time` is the time of its last modification and `changed` that of its last status change, in nanoseconds.
    """

    path: str
    kind: DependencyKind
    size: int = 0
    time: int = 0
    digest: str = ""
    changed: int = 0
    inode: int = 0


_ABSENT = Dependency("", DependencyKind.ABSENT)


def status(path: str) -> os.stat_result | None:
    """Return the status of a path; None where nothing is there."""
    try:
        return os.stat(path)  # noqa: PTH116 - a path for each of a million models has to be made only once
    except (OSError, ValueError):
        return None


def dependencies_of(
    seen: Observation, root: str, *, outside: str | None, names: bool = False
) -> tuple[Dependency, ...] | None:
    """Return what was seen, but not in its parts, with digests of what was read.

    It is None if something changed or failed meanwhile. Files in the folder `outside` are left out: results are no
    inputs. With `names`, it counts too where links lead, and where nothing was found that would make a folder a root.
    """
    if seen.failed:
        return None
    found: list[Dependency] = []
    for kind, table in ((DependencyKind.READ, seen.read), (DependencyKind.LISTED, seen.listed)):
        for path, before in table.items():
            if _is_below(path, outside):
                continue
            dependency = _record_content(path, kind, before)
            if dependency is None or seen.young.get(path, dependency.digest) != dependency.digest:
                return None
            found.append(_make_relative(dependency, root))
    looks = ((path, before) for path, before in seen.looked_at.items() if path not in seen.read)
    found += [
        _make_relative(_describe_status(path, before), root) for path, before in looks if not _is_below(path, outside)
    ]
    if names:
        found += [Dependency(path, DependencyKind.NAMED, digest=stood) for path, stood in seen.names.items()]
    return tuple(found)


def stamp(path: Path, name: str, made: str) -> Dependency:
    """Return a result as it was written."""
    return _add_status(Dependency(name, DependencyKind.READ, digest=made), path.stat())


def has_other_variables(variables: Mapping[str, str | None]) -> bool:
    """Whether an environment variable has another value than it had."""
    return any(os.environ.get(name) != value for name, value in variables.items())


def are_current(
    dependencies: Iterable[Dependency],
    root: str,
    *,
    noted: int | None = None,
    status: Status = status,
    contents: Mapping[str, str] = MappingProxyType({}),
) -> bool:
    """Return whether the status of every file proves that nothing has changed, without opening any.

    `noted` is the time of the record; results, which nobody else writes, need none. `contents` has the digests of files
    that the caller has just written, by their path below the root: these are compared instead of the status.
    """
    for each in dependencies:
        path = os.path.join(root, each.path)  # noqa: PTH118 - as above
        if contents and each.kind is DependencyKind.READ and path != each.path:
            same = contents.get(normpath(each.path)) == each.digest
        elif contents and each.kind is DependencyKind.LISTED and path != each.path:
            same = _digest_content(path, DependencyKind.LISTED) == each.digest
        else:
            same = _is_current(each, status(path), noted)
        if not same:
            return False
    return True


def are_same(dependencies: Iterable[Dependency], root: str) -> bool:
    """Return whether the content of every file is as it was."""
    return renewed(dependencies, root) is not None


def renewed(dependencies: Iterable[Dependency], root: str) -> tuple[Dependency, ...] | None:
    """Return the dependencies with their status now; None if the content of one has changed."""
    found: list[Dependency] = []
    for each in dependencies:
        now = _renew(each, os.path.join(root, each.path))  # noqa: PTH118 - as above
        if now is None:
            return None
        found.append(now)
    return tuple(found)


def is_there(dependency: Dependency, root: str) -> bool:
    """Return whether anything is at the path of a dependency."""
    return status(os.path.join(root, dependency.path)) is not None  # noqa: PTH118 - as above


def packed(dependencies: Iterable[Dependency]) -> list[list[object]]:
    """Return dependencies as lists, without what is empty at their ends."""
    rows = [list[object](dependency) for dependency in dependencies]
    for row in rows:
        while not row[-1]:
            row.pop()
    return rows


def unpacked(rows: Iterable[list[Any]]) -> Iterator[Dependency]:
    """Read dependencies from lists as `packed` writes them.

    Raises:
        ValueError, TypeError: one is no dependency.
    """
    for path, kind, *rest in rows:
        made = Dependency(path, DependencyKind(kind), *rest)
        if any(type(value) is not type(usual) for value, usual in zip(made, _ABSENT, strict=True)):
            raise TypeError(path)
        yield made


def _record_content(path: str, kind: DependencyKind, before: os.stat_result | None) -> Dependency | None:
    """Return what was read or listed, as it is now; None if it has changed since."""
    now = status(path)
    if before is None or now is None:
        return Dependency(path, DependencyKind.ABSENT) if before is now else None
    # The file has changed between being read and now: what was read may be any mixture of both.
    if _compare_key(before) != _compare_key(now):
        return None
    usual = stat.S_ISREG if kind is DependencyKind.READ else stat.S_ISDIR
    if not usual(now.st_mode):
        return _describe_status(path, now)
    made = _digest_content(path, kind)
    return None if made is None else _add_status(Dependency(path, kind, digest=made), now)


def _add_status(dependency: Dependency, now: os.stat_result) -> Dependency:
    size = now.st_size if dependency.kind is DependencyKind.READ else 0
    return dependency._replace(size=size, time=now.st_mtime_ns, changed=now.st_ctime_ns, inode=now.st_ino)


def _compare_key(status: os.stat_result) -> tuple[int, ...]:
    return status.st_size, status.st_mtime_ns, status.st_ctime_ns, status.st_ino


def _digest_content(path: str, kind: DependencyKind) -> str | None:
    try:
        return digest(read_regular(Path(path))) if kind is DependencyKind.READ else _digest_names(path)
    except OSError:
        return None


def _digest_names(path: str) -> str:
    with os.scandir(path) as entries:
        names = sorted(map(_describe_entry, islice(entries, _MOST_NAMES + 1)))
    return digest(os.fsencode("\0".join(names))) if len(names) <= _MOST_NAMES else ""


def _describe_entry(entry: os.DirEntry[str]) -> str:
    """Return the name of an entry, and whether it is a folder or a link: a listing is asked for these too."""
    return f"{entry.name}{'/' if entry.is_dir() else ''}{'/@' if entry.is_symlink() else ''}"


def _describe_status(path: str, now: os.stat_result | None) -> Dependency:
    if now is None:
        return Dependency(path, DependencyKind.ABSENT)
    if stat.S_ISREG(now.st_mode):
        return Dependency(path, DependencyKind.FILE, now.st_size)
    return Dependency(path, DependencyKind.FOLDER if stat.S_ISDIR(now.st_mode) else DependencyKind.OTHER)


def _make_relative(dependency: Dependency, root: str) -> Dependency:
    if dependency.path != root and not _is_below(dependency.path, root):
        return dependency
    return dependency._replace(path=dependency.path[len(root) :].lstrip(os.sep))


def _is_below(path: str, folder: str | None) -> bool:
    return folder is not None and path.startswith(folder.rstrip(os.sep) + os.sep)


def _is_current(dependency: Dependency, now: os.stat_result | None, noted: int | None) -> bool:
    if dependency.kind is DependencyKind.NAMED:
        return describe_name(dependency.path) == dependency.digest
    if dependency.kind not in {DependencyKind.READ, DependencyKind.LISTED}:
        return _describe_status(dependency.path, now) == dependency
    if now is None or (dependency.kind is DependencyKind.READ and now.st_size != dependency.size):
        return False
    # Digests of everything in every run would need no trust at all, but they open every mesh: 28 s
    # over the corpus, where a run with nothing to do takes less than one, in the process that must
    # open nothing.
    if (now.st_mtime_ns, now.st_ctime_ns, now.st_ino) != (dependency.time, dependency.changed, dependency.inode):
        return False
    # images of squashfs and mounts by FUSE have no time of a change but the one that came along, in whole seconds
    if is_coarse(dependency.changed):
        return False
    # As in git ("racy git"): a file can change twice within one step of a file system's clock (4 ms
    # on ext4, 1 s on NFS, 2 s on FAT) with the same status for two contents.
    return noted is None or not is_young(dependency.time, dependency.changed, noted)


def _renew(dependency: Dependency, path: str) -> Dependency | None:
    """Return a dependency with its status from before its content was compared; None if the content has changed."""
    if dependency.kind is DependencyKind.NAMED:
        return dependency if describe_name(path) == dependency.digest else None
    now = status(path)
    if dependency.kind not in {DependencyKind.READ, DependencyKind.LISTED}:
        return dependency if _describe_status(dependency.path, now) == dependency else None
    if now is None or not dependency.digest or _digest_content(path, dependency.kind) != dependency.digest:
        return None
    return _add_status(dependency, now)


_PLAIN = bool | int | float | str
_NO_CODE = frozenset({"__pycache__"})
_OWN = str(Path(__file__).resolve().parents[1])
_INSTALLED = tuple(sysconfig.get_path(name) for name in ("purelib", "platlib"))


def describe_options(value: object) -> object:
    """Return a job or one of its options as JSON, so that results are redone when any of them changes."""
    if isinstance(value, Pipeline):
        return [str(value), sorted(f"{owner} {version(owner)}" for owner in owners_of(value))]
    if isinstance(value, frozenset):
        return sorted(map(str, cast("frozenset[object]", value)))
    if isinstance(value, tuple | list):
        return [describe_options(each) for each in cast("tuple[object, ...]", value)]
    if isinstance(value, Mapping):
        return [[str(key), describe_options(each)] for key, each in cast("Mapping[object, object]", value).items()]
    if is_dataclass(value):
        options = (describe_options(getattr(value, each.name)) for each in fields(value) if each.compare)
        return [type(value).__name__, *options]
    return value if value is None or isinstance(value, _PLAIN) else str(value)


def owners_of(passes: Pipeline) -> set[str]:
    """Return the packages that the passes of a pipeline come from."""
    known = registered_passes()
    return {owner for step in passes if step.name in known and (owner := known[step.name].owner)}


@cache
def installation() -> str:
    """Return a digest of what is installed: Python, every package with its version, and our code if it is edited."""
    packages = sorted(name for folder in sys.path for name in _packages_in(folder))
    own = sorted(_code_below(_OWN)) if not _OWN.startswith(_INSTALLED) else []
    return digest("\n".join([sys.version, version("twinform"), *packages, *own]).encode(errors="surrogateescape"))


def _packages_in(folder: str) -> list[str]:
    """Return the names of the folders that describe installed packages, which have their versions in them."""
    try:
        return [name for name in os.listdir(folder) if name.endswith((".dist-info", ".egg-info"))]  # noqa: PTH208 - many
    except OSError:  # an archive, or no longer there
        return []


def _code_below(folder: str) -> Iterator[str]:
    """Yield the status of every file of the package: one that is edited in place keeps its version."""
    with os.scandir(folder) as entries:
        for entry in entries:
            if not entry.is_dir():
                status = entry.stat()
                yield f"{entry.path} {status.st_size} {status.st_mtime_ns} {status.st_ctime_ns} {status.st_ino}"
            elif entry.name not in _NO_CODE:
                yield from _code_below(entry.path)
