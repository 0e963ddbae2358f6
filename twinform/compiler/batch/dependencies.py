"""What a result depends on: files that were read, listed or looked for, as they were, and whether they still are so.

As git does, size, times and inode of a file are compared first, and digests where any of these differs. The time at
which the status of a file changed is the one that nobody can set: archives that are reproducible, `rsync -t`, Nix and
Bazel give files of different contents one modification time, often with one size.

A file that was written shortly before it was read may have changed again within one step of a clock, of ours or of a
file server: its status proves nothing, and its digest is compared each time.
"""

import os
import stat
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from posixpath import normpath
from types import MappingProxyType
from typing import Any

from twinform.compiler.observing import Observation, digest, is_coarse, is_young
from twinform.file_access import read_regular

_NOTHING = (0, 0, "", 0, 0)
"""What a dependency has where a row ends early."""
_MOST_NAMES = 100_000
"""Entries of a folder; one with more is always listed again."""
Status = Callable[[str], os.stat_result | None]
"""The status of a path; None where nothing is there."""


class DependencyKind(StrEnum):
    """What was found at a path, or done with it."""

    ABSENT = "absent"
    READ = "read"
    LISTED = "listed"
    FOLDER = "folder"
    FILE = "file"
    """It was only looked at."""
    OTHER = "other"
    """A pipe, device or socket."""


@dataclass(frozen=True, slots=True)
class Dependency:
    """A path, below the folder of the models where it can be, and what was there.

    `time` is that of its last modification, `changed` that of the last change of its status, in nanoseconds.
    """

    path: str
    kind: DependencyKind
    size: int = 0
    time: int = 0
    digest: str = ""
    changed: int = 0
    inode: int = 0


def status(path: str) -> os.stat_result | None:
    """The status of a path; None where nothing is there."""
    try:
        return os.stat(path)  # noqa: PTH116 - a path for each of a million models has to be made only once
    except (OSError, ValueError):
        return None


def dependencies_of(seen: Observation, root: str, *, outside: str | None) -> tuple[Dependency, ...] | None:
    """What was seen, with the digests of what was read; None where something has changed or failed on the way.

    What lies in the folder `outside` is left out: results are no inputs.
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
            found.append(_below_root(dependency, root))
    looks = ((path, before) for path, before in seen.looked_at.items() if path not in seen.read)
    found += [_below_root(_look(path, before), root) for path, before in looks if not _is_below(path, outside)]
    return tuple(found)


def stamp(path: Path, name: str, made: str) -> Dependency:
    """A result as it was written."""
    return _stamped(Dependency(name, DependencyKind.READ, digest=made), path.stat())


def are_current(
    dependencies: Iterable[Dependency],
    root: str,
    *,
    noted: int | None = None,
    status: Status = status,
    contents: Mapping[str, str] = MappingProxyType({}),
) -> bool:
    """Whether all is as it was by status, without opening anything; False where that is not enough.

    `noted` is the time of the record; results, which nobody else writes, do without. `contents` are digests of files
    by their path below the root, where the caller has just written these: they are compared, and no status is.
    """
    for each in dependencies:
        path = os.path.join(root, each.path)  # noqa: PTH118 - as above
        if contents and each.kind is DependencyKind.READ and path != each.path:
            same = contents.get(normpath(each.path)) == each.digest
        elif contents and each.kind is DependencyKind.LISTED and path != each.path:
            same = _content(path, DependencyKind.LISTED) == each.digest
        else:
            same = _is_current(each, status(path), noted)
        if not same:
            return False
    return True


def are_same(dependencies: Iterable[Dependency], root: str) -> bool:
    """Whether all is as it was by its content."""
    return renewed(dependencies, root) is not None


def renewed(dependencies: Iterable[Dependency], root: str) -> tuple[Dependency, ...] | None:
    """All with the status that they have now; None where a content is another one."""
    found: list[Dependency] = []
    for each in dependencies:
        now = _renewed(each, os.path.join(root, each.path))  # noqa: PTH118 - as above
        if now is None:
            return None
        found.append(now)
    return tuple(found)


def is_there(dependency: Dependency, root: str) -> bool:
    """Whether anything is at the path of a dependency."""
    return status(os.path.join(root, dependency.path)) is not None  # noqa: PTH118 - as above


def packed(dependencies: Iterable[Dependency]) -> list[list[object]]:
    """Dependencies as lists, without what is empty at their ends."""
    rows: list[list[object]] = []
    for dependency in dependencies:
        row: list[object] = [dependency.path, str(dependency.kind), dependency.size, dependency.time, dependency.digest]
        row += [dependency.changed, dependency.inode]
        while not row[-1]:
            row.pop()
        rows.append(row)
    return rows


def unpacked(rows: Iterable[Iterable[Any]]) -> Iterator[Dependency]:
    """Read dependencies from lists as `packed` writes them.

    Raises:
        ValueError, TypeError: one is no dependency.
    """
    for path, kind, *rest in rows:
        values: list[Any] = [*rest, *_NOTHING[len(rest) :]]
        size, time, made, changed, inode = values
        if not (isinstance(path, str) and isinstance(made, str)):
            raise TypeError(path)
        if not all(isinstance(number, int) for number in (size, time, changed, inode)):
            raise TypeError(path)
        yield Dependency(path, DependencyKind(kind), size, time, made, changed, inode)


def _record_content(path: str, kind: DependencyKind, before: os.stat_result | None) -> Dependency | None:
    """What is read or listed, as it is now; None where it is not as it was before."""
    now = status(path)
    if before is None or now is None:
        return Dependency(path, DependencyKind.ABSENT) if before is now else None
    # The file has changed between being read and now: what was read may be any mixture of both.
    if _status_marks(before) != _status_marks(now):
        return None
    usual = stat.S_ISREG if kind is DependencyKind.READ else stat.S_ISDIR
    if not usual(now.st_mode):
        return _look(path, now)
    made = _content(path, kind)
    return None if made is None else _stamped(Dependency(path, kind, digest=made), now)


def _stamped(dependency: Dependency, now: os.stat_result) -> Dependency:
    size = now.st_size if dependency.kind is DependencyKind.READ else 0
    return replace(dependency, size=size, time=now.st_mtime_ns, changed=now.st_ctime_ns, inode=now.st_ino)


def _status_marks(status: os.stat_result) -> tuple[int, ...]:
    return status.st_size, status.st_mtime_ns, status.st_ctime_ns, status.st_ino


def _content(path: str, kind: DependencyKind) -> str | None:
    try:
        return digest(read_regular(Path(path))) if kind is DependencyKind.READ else _names(path)
    except OSError:
        return None


def _names(path: str) -> str:
    names = sorted(os.listdir(path))  # noqa: PTH208 - only the names
    return digest(os.fsencode("\0".join(names))) if len(names) <= _MOST_NAMES else ""


def _look(path: str, now: os.stat_result | None) -> Dependency:
    if now is None:
        return Dependency(path, DependencyKind.ABSENT)
    if stat.S_ISREG(now.st_mode):
        return Dependency(path, DependencyKind.FILE, now.st_size)
    return Dependency(path, DependencyKind.FOLDER if stat.S_ISDIR(now.st_mode) else DependencyKind.OTHER)


def _below_root(dependency: Dependency, root: str) -> Dependency:
    if dependency.path != root and not _is_below(dependency.path, root):
        return dependency
    return replace(dependency, path=dependency.path[len(root) :].lstrip(os.sep))


def _is_below(path: str, folder: str | None) -> bool:
    return folder is not None and path.startswith(folder.rstrip(os.sep) + os.sep)


def _is_current(dependency: Dependency, now: os.stat_result | None, noted: int | None) -> bool:
    if dependency.kind not in {DependencyKind.READ, DependencyKind.LISTED}:
        return _look(dependency.path, now) == dependency
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


def _renewed(dependency: Dependency, path: str) -> Dependency | None:
    """A dependency with its status from before its content was compared; None where that is another one."""
    now = status(path)
    if dependency.kind not in {DependencyKind.READ, DependencyKind.LISTED}:
        return dependency if _look(dependency.path, now) == dependency else None
    if now is None or not dependency.digest or _content(path, dependency.kind) != dependency.digest:
        return None
    return _stamped(dependency, now)
