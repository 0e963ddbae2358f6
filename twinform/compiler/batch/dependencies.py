"""What a result depends on: files that were read, listed or looked for, as they were, and whether they still are so.

As build systems do, size and time of a file are compared first, and digests where these differ. A file that was
written less than `TICK` before it was read may have changed again within one step of a clock, of ours or of a
file server: its time proves nothing, and its digest is compared each time.
"""

import os
import stat
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

from twinform.compiler.input.regular_files import read_regular
from twinform.compiler.observing import TICK, Observation, digest

_MOST_NAMES = 100_000
"""Entries of a folder; one with more is always listed again."""
Status = Callable[[str], os.stat_result | None]
"""The status of a path; None where nothing is there."""


class Kind(StrEnum):
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
    """A path, below the folder of the models where it can be, and what was there."""

    path: str
    kind: Kind
    size: int = 0
    time: int = 0
    digest: str = ""


def status(path: str) -> os.stat_result | None:
    """The status of a path; None where nothing is there."""
    try:
        return os.stat(path)  # noqa: PTH116 - a path for each of a million models has to be made only once
    except (OSError, ValueError):
        return None


def dependencies_of(seen: Observation, root: str, *, outside: str | None) -> tuple[Dependency, ...] | None:
    """What was seen, with the digests of what was read; None where something has changed on the way.

    What lies in the folder `outside` is left out: results are no inputs.
    """
    found: list[Dependency] = []
    for kind, table in ((Kind.READ, seen.read), (Kind.LISTED, seen.listed)):
        for path, before in table.items():
            if _is_below(path, outside):
                continue
            dependency = _noted(path, kind, before)
            if dependency is None or seen.young.get(path, dependency.digest) != dependency.digest:
                return None
            found.append(_placed(dependency, root))
    looks = ((path, before) for path, before in seen.looked_at.items() if path not in seen.read)
    found += [_placed(_look(path, before), root) for path, before in looks if not _is_below(path, outside)]
    return tuple(found)


def stamp(path: Path, name: str, made: str) -> Dependency:
    """A result as it was written."""
    now = path.stat()
    return Dependency(name, Kind.READ, now.st_size, now.st_mtime_ns, made)


def are_current(
    dependencies: Iterable[Dependency], root: str, *, noted: int | None = None, status: Status = status
) -> bool:
    """Whether all is as it was by status, without opening anything; False where that is not enough.

    `noted` is the time of the record; results, which nobody else writes, do without.
    """
    paths = ((each, os.path.join(root, each.path)) for each in dependencies)  # noqa: PTH118 - as above
    return all(_is_current(each, status(path), noted) for each, path in paths)


def are_same(dependencies: Iterable[Dependency], root: str) -> bool:
    """Whether all is as it was by its content."""
    return all(_is_same(dependency, os.path.join(root, dependency.path)) for dependency in dependencies)  # noqa: PTH118 - as above


def packed(dependencies: Iterable[Dependency]) -> list[list[object]]:
    """Dependencies as lists, without what is empty at their ends."""
    rows: list[list[object]] = []
    for dependency in dependencies:
        row: list[object] = [dependency.path, str(dependency.kind), dependency.size, dependency.time, dependency.digest]
        while not row[-1]:
            row.pop()
        rows.append(row)
    return rows


def unpacked(rows: Iterable[Iterable[Any]]) -> Iterator[Dependency]:
    """The same back.

    Raises:
        ValueError, TypeError: one is no dependency.
    """
    for path, kind, *rest in rows:
        size, time, made = (*rest, *(0, 0, "")[len(rest) :])
        if not (isinstance(path, str) and isinstance(size, int) and isinstance(time, int) and isinstance(made, str)):
            raise TypeError(path)
        yield Dependency(path, Kind(kind), size, time, made)


def _noted(path: str, kind: Kind, before: os.stat_result | None) -> Dependency | None:
    """What is read or listed, as it is now; None where it is not as it was before."""
    now = status(path)
    if before is None or now is None:
        return Dependency(path, Kind.ABSENT) if before is now else None
    if (before.st_mtime_ns, before.st_size, before.st_ino) != (now.st_mtime_ns, now.st_size, now.st_ino):
        return None
    usual = stat.S_ISREG if kind is Kind.READ else stat.S_ISDIR
    if not usual(now.st_mode):
        return _look(path, now)
    made = _content(path, kind)
    size = now.st_size if kind is Kind.READ else 0
    return None if made is None else Dependency(path, kind, size, now.st_mtime_ns, made)


def _content(path: str, kind: Kind) -> str | None:
    try:
        return digest(read_regular(Path(path))) if kind is Kind.READ else _names(path)
    except OSError:
        return None


def _names(path: str) -> str:
    names = sorted(os.listdir(path))  # noqa: PTH208 - only the names
    return digest(os.fsencode("\0".join(names))) if len(names) <= _MOST_NAMES else ""


def _look(path: str, now: os.stat_result | None) -> Dependency:
    if now is None:
        return Dependency(path, Kind.ABSENT)
    if stat.S_ISREG(now.st_mode):
        return Dependency(path, Kind.FILE, now.st_size)
    return Dependency(path, Kind.FOLDER if stat.S_ISDIR(now.st_mode) else Kind.OTHER)


def _placed(dependency: Dependency, root: str) -> Dependency:
    if dependency.path != root and not _is_below(dependency.path, root):
        return dependency
    return Dependency(
        dependency.path[len(root) :].lstrip(os.sep),
        dependency.kind,
        dependency.size,
        dependency.time,
        dependency.digest,
    )


def _is_below(path: str, folder: str | None) -> bool:
    return folder is not None and path.startswith(folder.rstrip(os.sep) + os.sep)


def _is_current(dependency: Dependency, now: os.stat_result | None, noted: int | None) -> bool:
    if dependency.kind not in {Kind.READ, Kind.LISTED}:
        return _look(dependency.path, now) == dependency
    if (
        now is None
        or now.st_mtime_ns != dependency.time
        or (dependency.kind is Kind.READ and now.st_size != dependency.size)
    ):
        return False
    return noted is None or dependency.time < noted - TICK


def _is_same(dependency: Dependency, path: str) -> bool:
    if dependency.kind not in {Kind.READ, Kind.LISTED}:
        return _look(dependency.path, status(path)) == dependency
    return bool(dependency.digest) and _content(path, dependency.kind) == dependency.digest
