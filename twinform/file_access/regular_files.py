"""Reads regular files only: pipes, devices and sockets are refused before a read could block."""

import errno
import os
import stat
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

_DO_NOT_WAIT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
STREAMS = ("/dev/", "/proc/")
"""How paths of streams begin that somebody names on purpose, such as `/dev/stdin`, which is a link itself."""
_WORDS = {
    stat.S_IFIFO: "a pipe",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFSOCK: "a socket",
}
# Bytes that are read at once. Most files are smaller, and Python reserves as much memory as it is
# asked for.
_PIECE = 2**16


def read_regular(path: Path, size: int | None = None, check: Callable[[str], object] | None = None) -> bytes:
    """The bytes of a file, or of one that has more than `size`, one byte more than these; symbolic links are followed.

    `check` is called with the place of the file that was opened, without links, and raises where it must not be read.

    Raises:
        OSError: it cannot be read, or is no regular file.
    """
    _require_regular(path.stat(), path)
    # Opening a named pipe for reading blocks until somebody writes to it; O_NONBLOCK returns at
    # once.
    descriptor = os.open(path, os.O_RDONLY | _DO_NOT_WAIT)
    with os.fdopen(descriptor, "rb") as file:
        status = os.fstat(file.fileno())
        _require_regular(status, path)  # something else may have taken its place
        if check is not None:
            check(_place_of(file.fileno(), path, status))
        return file.read() if size is None else read_up_to(file, size)


def read_up_to(file: BinaryIO, size: int) -> bytes:
    """What is in a file; of one that has more bytes, one byte more than these."""
    parts: list[bytes] = []
    left = size + 1
    while left > 0:
        wanted = min(left, _PIECE)
        parts.append(file.read(wanted))
        left = left - wanted if len(parts[-1]) == wanted else 0
    return b"".join(parts)


def _require_regular(status: os.stat_result, path: Path) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    if not stat.S_ISREG(status.st_mode):
        kind = _WORDS.get(stat.S_IFMT(status.st_mode), "something else")
        raise OSError(errno.EINVAL, f"it is {kind} and no file", str(path))


def _place_of(descriptor: int, path: Path, status: os.stat_result) -> str:
    """Where an open file really is.

    Raises:
        OSError: that is not known, since something was moved meanwhile.
    """
    try:
        return os.readlink(f"/proc/self/fd/{descriptor}").removesuffix(" (deleted)")
    except OSError:  # Linux alone knows it of the open file
        place = os.path.realpath(path)
        if not os.path.samestat(os.stat(place, follow_symlinks=False), status):
            raise
        return place
