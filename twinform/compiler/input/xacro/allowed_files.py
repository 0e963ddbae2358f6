"""The files that a xacro file may read: those of some folders, and nothing but regular files.

The process that expands can open nothing itself. It asks here, in another process, so that nothing of what is decided
lies within its reach.
"""

import os
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase

from twinform.compiler.input.size_limits import LARGEST
from twinform.compiler.observing import note_look
from twinform.file_access import OutsideError, Readable

_MAGIC = re.compile(r"[*?[]")
_MOST_LOOKED_AT = 10_000
"""Entries of folders, for one pattern."""


class DeniedError(Exception):
    """A xacro file has asked for what it must not read; `advice` is what to do if that is meant."""

    def __init__(self, message: str, advice: str = "") -> None:
        super().__init__(message)
        self.advice = advice


@dataclass(frozen=True, slots=True)
class AllowedFiles:
    """The files that a xacro file may read."""

    readable: Readable

    def read(self, path: str) -> bytes:
        """What is in a file.

        Raises:
            DeniedError: it must not be read.
            OSError: it cannot be read.
        """
        try:
            data = self.readable.read(path, LARGEST)
        except OutsideError as error:
            raise _denied(path, error) from error
        if len(data) > LARGEST:
            raise DeniedError(f"cannot read {path!r}: the file is larger than {LARGEST:,} bytes")
        return data

    def match(self, pattern: str) -> list[str]:
        """The files that match a pattern, as the shell has them.

        Raises:
            DeniedError: it leads to where nothing may be read, or to too much.
        """
        parts = [part for place, part in enumerate(pattern.split("/")) if part or not place]
        first = next((place for place, part in enumerate(parts) if _MAGIC.search(part)), len(parts))
        start = "".join(f"{part}/" for part in parts[:first])
        self.require_readable(start or ".")
        if ".." in parts[first:]:
            raise DeniedError(f"the pattern {pattern!r} must not go up behind a wildcard")
        found, left = [start], _MOST_LOOKED_AT
        for part in parts[first:]:
            found, left = self._step(found, part, left)
            if left < 0:
                raise DeniedError(f"the pattern {pattern!r} looks through more than {_MOST_LOOKED_AT:,} files")
        return sorted(path.rstrip("/") for path in found)

    def _step(self, folders: Iterable[str], part: str, left: int) -> tuple[list[str], int]:
        """What is in folders, each with a slash behind it, of the name of one part of a pattern."""
        found: list[str] = []
        for folder in filter(self.readable.allows, folders):
            for name in _entries(folder, part):
                left -= 1
                if left < 0:
                    return found, left
                # what is hidden can be named in a pattern, and is then refused
                if fnmatchcase(name, part) and (not name.startswith(".") or part.startswith(".")):
                    found.append(f"{folder}{name}/")
        return found, left

    def require_readable(self, path: str) -> None:
        """Refuse a file that must not be read.

        Raises:
            DeniedError: it lies outside, or is hidden.
        """
        try:
            self.readable.require(path)
        except OutsideError as error:
            raise _denied(path, error) from error


def _denied(path: str, error: OutsideError) -> DeniedError:
    return DeniedError(f"cannot read {path!r}: it {error.reason}", error.help)


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
