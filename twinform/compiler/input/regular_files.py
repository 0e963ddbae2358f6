"""Reads regular files only: pipes, devices and sockets are refused before a read could block."""

import errno
import os
import stat
from pathlib import Path

from twinform.compiler.input.limits import read_up_to

_DO_NOT_WAIT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_BINARY", 0)
_WORDS = {
    stat.S_IFIFO: "a pipe",
    stat.S_IFCHR: "a device",
    stat.S_IFBLK: "a device",
    stat.S_IFSOCK: "a socket",
    stat.S_IFDIR: "a folder",
}


def read_regular(path: Path, size: int | None = None) -> bytes:
    """The bytes of a file, or of one that has more than `size`, one byte more than these; symbolic links are followed.

    Raises:
        OSError: it cannot be read, or is no regular file.
    """
    _require_regular(path.stat(), path)
    descriptor = os.open(path, os.O_RDONLY | _DO_NOT_WAIT)
    with os.fdopen(descriptor, "rb") as file:
        _require_regular(os.fstat(file.fileno()), path)  # something else may have taken its place
        return file.read() if size is None else read_up_to(file, size)


def _require_regular(status: os.stat_result, path: Path) -> None:
    if not stat.S_ISREG(status.st_mode):
        kind = _WORDS.get(stat.S_IFMT(status.st_mode), "something else")
        raise OSError(errno.EINVAL, f"it is {kind} and no file", str(path))
