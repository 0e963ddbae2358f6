"""The files that a xacro file may read: those of some folders, and nothing but regular files.

The process that expands can open nothing itself. It asks here, in another process, so that nothing of what is decided
lies within its reach.
"""

import os
import re
import stat
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase

from twinform.compiler.input.limits import LARGEST
from twinform.compiler.observing import note_look

_OUTSIDE = "it is outside of the folders of models and packages"
_ADVICE = "name its folder with --path DIR if it is meant"
_MAGIC = re.compile(r"[*?[]")
_MOST_LOOKED_AT = 10_000
"""Entries of folders, for one pattern."""


class OutsideError(Exception):
    """What was asked for is not for a xacro file."""

    def __init__(self, message: str, advice: str = "") -> None:
        super().__init__(message)
        self.advice = advice


@dataclass(frozen=True, slots=True)
class Files:
    """The files that may be read: `single` ones, and those in `folders` and in `trusted` ones.

    In folders, what counts is where a file really is. Trusted ones are those that the environment names: the user's own
    installation, in which links lead to where it was built from, so that there the name counts as well.
    """

    single: frozenset[str]
    folders: tuple[str, ...]
    trusted: tuple[str, ...]

    @classmethod
    def of(cls, single: Iterable[str], folders: Iterable[str], trusted: Iterable[str]) -> "Files":
        """The same, with all links followed but those of trusted folders."""
        return cls(
            frozenset(map(os.path.realpath, single)),
            tuple(map(os.path.realpath, folders)),
            tuple(map(os.path.abspath, trusted)),
        )

    def read(self, path: str) -> bytes:
        """What is in a file.

        Raises:
            OutsideError: it must not be read.
            OSError: it cannot be read.
        """
        self.require_inside(path)
        # opening a pipe would wait for somebody to write, and a device may do anything
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
        try:
            status = os.fstat(descriptor)
            if not stat.S_ISREG(status.st_mode):
                raise OutsideError(f"cannot read {path!r}: it is no file")
            if status.st_size > LARGEST:
                raise OutsideError(f"cannot read {path!r}: the file is larger than {LARGEST:,} bytes")
            with os.fdopen(descriptor, "rb", closefd=False) as file:
                return file.read(LARGEST)
        finally:
            os.close(descriptor)

    def match(self, pattern: str) -> list[str]:
        """The files that match a pattern, as the shell has them.

        Raises:
            OutsideError: it leads to where nothing may be read, or to too much.
        """
        parts = [part for place, part in enumerate(pattern.split("/")) if part or not place]
        first = next((place for place, part in enumerate(parts) if _MAGIC.search(part)), len(parts))
        start = "".join(f"{part}/" for part in parts[:first])
        self.require_inside(start or ".")
        if ".." in parts[first:]:
            raise OutsideError(f"the pattern {pattern!r} must not go up behind a wildcard")
        found, left = [start], _MOST_LOOKED_AT
        for part in parts[first:]:
            found, left = self._step(found, part, left)
            if left < 0:
                raise OutsideError(f"the pattern {pattern!r} looks through more than {_MOST_LOOKED_AT:,} files")
        return sorted(path.rstrip("/") for path in found)

    def _step(self, folders: Iterable[str], part: str, left: int) -> tuple[list[str], int]:
        """What is in folders, each with a slash behind it, of the name of one part of a pattern."""
        found: list[str] = []
        for folder in filter(self._is_inside, folders):
            for name in _entries(folder, part):
                left -= 1
                if left < 0:
                    return found, left
                if fnmatchcase(name, part) and (not name.startswith(".") or part.startswith(".")):
                    found.append(f"{folder}{name}/")
        return found, left

    def require_inside(self, path: str) -> None:
        """Refuse a file that must not be read.

        Raises:
            OutsideError: it lies outside.
        """
        if not self._is_inside(path):
            raise OutsideError(f"cannot read {path!r}: {_OUTSIDE}", _ADVICE)

    def _is_inside(self, path: str) -> bool:
        where = os.path.realpath(path)
        return where in self.single or _inside(where, self.folders) or _inside(os.path.abspath(path), self.trusted)


def _entries(folder: str, part: str) -> Iterator[str]:
    if not _MAGIC.search(part):
        note_look(f"{folder}{part}")
        yield from [part] if os.path.lexists(f"{folder}{part}") else []
        return
    try:
        with os.scandir(folder or ".") as entries:
            yield from (entry.name for entry in entries)
    except OSError:  # no folder, or a closed one
        return


def _inside(path: str, folders: Iterable[str]) -> bool:
    return any(path == each or path.startswith(each.rstrip(os.sep) + os.sep) for each in folders)
