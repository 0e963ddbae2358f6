"""Writing files so that no reader ever sees half of one."""

import errno
import os
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path


def write_atomically(path: Path, text: str) -> None:
    """Put the text where `path` is, all of it or nothing: it is written beside it and then moved over it.

    The permissions of a file that is replaced stay. A symbolic link is followed.

    Raises:
        OSError: the text could not be written; the old file is untouched.
    """
    write_all_atomically({path: text})


def write_all_atomically(texts: Mapping[Path, str]) -> None:
    """Put every text in its place once all of them are written beside it.

    Raises:
        OSError: one of them could not be written; the old files are untouched.
    """
    staged: list[tuple[Path, Path]] = []
    try:
        for path, text in texts.items():
            target = path.resolve()
            staged.append((_staged(target, text), target))
        for temporary, target in staged:
            temporary.replace(target)
    except BaseException:
        for temporary, _ in staged:
            with suppress(OSError):
                temporary.unlink(missing_ok=True)
        raise


def _staged(path: Path, text: str) -> Path:
    """The text in a file beside the one that it is for."""
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, "it is a directory", str(path))
    mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~_umask()
    descriptor, name = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    temporary = Path(name)
    try:
        with os.fdopen(descriptor, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        temporary.chmod(mode)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise
    return temporary


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
