"""Writing files so that no reader ever sees half of one."""

import errno
import os
import stat
import tempfile
from collections.abc import Generator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

_PREFIX = 64
"""So much of its name has a file that is being written, which must not be longer than the name that it will have."""


def write_atomically(path: Path, text: str) -> None:
    """Put the text where `path` is, all of it or nothing: it is written beside it and then moved over it.

    Folders that are missing are made. The permissions of a file that is replaced stay. A symbolic link is followed. A
    pipe or device is written into.

    Raises:
        OSError: the text could not be written; the old file is untouched.
    """
    write_all_atomically({path: text})


def write_all_atomically(texts: Mapping[Path, str]) -> None:
    """Put every text in its place once all of them are written beside it; folders that are missing are made.

    Raises:
        OSError: one of them could not be written; the old files are untouched.
    """
    staged: list[tuple[Path, Path]] = []
    streams = [path for path in texts if _is_stream(path)]
    try:
        for path, text in texts.items():
            if path in streams:
                continue
            target = path.resolve()
            staged.append((_staged(target, text), target))
        for path in streams:
            _write_into(path, texts[path])
        for temporary, target in staged:
            temporary.replace(target)
    except BaseException:
        for temporary, _ in staged:
            with suppress(OSError):
                temporary.unlink(missing_ok=True)
        raise


def _is_stream(path: Path) -> bool:
    """Whether it is a pipe or device, such as /dev/null, which a file must never take the place of."""
    try:
        mode = path.stat().st_mode
    except (OSError, ValueError):
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def _write_into(path: Path, text: str) -> None:
    with _named_after(path), path.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write(text)


@contextmanager
def _named_after(path: Path) -> Generator[None]:
    """Say which file an error is about: a failed write does not know."""
    try:
        yield
    except OSError as error:
        error.filename = str(path)
        raise


def _staged(path: Path, text: str) -> Path:
    """The text in a file beside the one that it is for."""
    if path.is_dir():
        raise IsADirectoryError(errno.EISDIR, "it is a directory", str(path))
    mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~_umask()
    with _named_after(path):
        _make(path.parent)
        descriptor, name = tempfile.mkstemp(prefix=f".{path.name[:_PREFIX]}.", dir=path.parent)
    temporary = Path(name)
    try:
        with _named_after(path), os.fdopen(descriptor, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        temporary.chmod(mode)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise
    return temporary


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError as error:  # which would sound as if the file that is written were there
        raise NotADirectoryError(errno.ENOTDIR, "a file stands where its folder would be", str(folder)) from error


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
