"""Tells whether two paths lead to one file: by links, or by names that some file systems take for one."""

import os
import stat
import unicodedata
from collections.abc import Hashable, Iterator
from contextlib import suppress
from pathlib import Path


def identities(path: Path) -> Iterator[Hashable]:
    """Yield the identities of a file: where its path really leads, and its number in the file system.

    Pipes and devices, such as /dev/null, have none: writing into them replaces nothing.
    """
    status = None
    with suppress(OSError, ValueError):
        status = path.stat()
    if status is None or stat.S_ISREG(status.st_mode):
        yield os.path.realpath(path)
    if status is not None and stat.S_ISREG(status.st_mode):
        yield (status.st_dev, status.st_ino)


def folded(path: Path) -> Hashable:
    """Return a key that is equal for paths which some file systems take for one, as `Arm.sdf` and `arm.sdf`."""
    return unicodedata.normalize("NFC", os.path.realpath(path)).casefold()


def is_below(path: Path, folder: Path) -> bool:
    """Whether a path really leads into a folder, whatever symbolic links are on the way."""
    return Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def is_nothing(path: Path) -> bool:
    """Whether a path is the null device, into which any number of outputs may be written."""
    return os.path.realpath(path) == os.devnull


def is_open_at(descriptor: int, path: Path) -> bool:
    """Whether an open file is still the one that a path leads to."""
    try:
        return os.path.samestat(os.fstat(descriptor), path.stat())
    except OSError:
        return False
