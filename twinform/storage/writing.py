"""Atomic file output: no reader sees half a file, and of several files all are written or none.

Two paths may lead to one file, by links, or by names that some file systems take for one.
"""

import errno
import os
import stat
import unicodedata
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path

from twinform.file_access import STREAMS, OutsideError, Readable
from twinform.storage.transaction import Transaction, named_after, transaction

# Up to this many files are synced one after the other, more at once. Syncing 300 files of a package
# took 1.1 s one after the other and takes 0.14 s from 16 threads, since the file system merges them
# into one transaction. `os.sync` is faster still, but waits for everything that other programs have
# written.
_FEW = 4
_THREADS = 16


# A file is synced before it is moved, and its folder after that: 5 ms and 4 ms. Batch results and
# caches are written without it, because both notice half a file by its size or digest.
def write_atomically(path: str | Path, text: str | bytes, *, durably: bool = True) -> None:
    """Write a file completely or not at all: the text is written beside it and then moved over it.

    Folders that are missing are made. The permissions of a file that is replaced stay. A symbolic link is followed. A
    pipe or device is written into. `durably` waits until the disk has it.

    Raises:
        OSError: the text could not be written; the old file is untouched.
    """
    write_all_atomically({Path(path): text}, durably=durably)


def write_all_atomically(
    texts: Mapping[Path, str | bytes], then: Callable[[], None] | None = None, *, durably: bool = True
) -> None:
    """Write several files, and move them to their places once all are written; missing folders are made.

    `then` is called when nothing but moving them is left to do. Where that, or one of the moves, fails, those that were
    moved already are taken back. `durably` waits until the disk has them, so that not even a power cut leaves half a
    file in a place.

    Raises:
        OSError: one of them could not be written; the old files are as they were.
    """
    with transaction() as files:
        staged = stage_texts(files, texts, durably=durably)
        if then:
            then()
        for new, target in staged:
            with named_after(target):
                files.move(new, target, keep=len(staged) > 1)
        if durably:
            files.sync()
        files.done = True


def stage_texts(
    files: Transaction, texts: Mapping[Path, str | bytes], *, durably: bool = True
) -> list[tuple[Path, Path]]:
    """Write texts into staged files, or directly into pipes and devices; returns each staged file with its place.

    Raises:
        OSError: one of them cannot be written.
    """
    staged = [_stage(files, path, text) for path, text in texts.items() if not is_stream(path)]
    if durably:
        sync_files(staged)
    for new, target in staged:
        with named_after(target), suppress(FileNotFoundError):
            _take_over(target, new)
    for path, text in texts.items():
        if is_stream(path):
            _write_into(path, text)
    return staged


def write_new_file(path: Path, text: str | bytes) -> None:
    """Write a file that must not exist yet, completely or not at all.

    Raises:
        FileExistsError: something is there.
        OSError: the text could not be written.
    """
    with transaction() as files:
        new, target = _stage(files, path, text)
        sync_files([(new, target)])
        with named_after(path):
            files.move_to_new(new, target)
            files.sync()
        files.done = True


def is_stream(path: Path) -> bool:
    """Tell whether a path is a pipe or device, such as /dev/null, which a file must never replace."""
    try:
        mode = path.stat().st_mode
    except (OSError, ValueError):
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def sync_files(staged: Iterable[tuple[Path, Path]]) -> None:
    """Wait until the disk has the files; each comes with the path that an error is to name.

    Raises:
        OSError: the disk does not take it.
    """
    files = [*staged]
    if len(files) <= _FEW:
        for file in files:
            _sync(file)
        return
    from concurrent.futures import ThreadPoolExecutor  # noqa: PLC0415 - most calls write few files

    with ThreadPoolExecutor(_THREADS) as threads:
        for _ in threads.map(_sync, files):
            pass


def _sync(staged: tuple[Path, Path]) -> None:
    path, shown = staged
    with named_after(shown), path.open("r+b") as file:
        os.fsync(file.fileno())


def _stage(files: Transaction, path: Path, text: str | bytes) -> tuple[Path, Path]:
    """Write a text into a staged file; returns it with its place."""
    refuse_way_out(path)
    # The target of a link is replaced and not the link itself: a link may be how the user keeps the
    # file elsewhere.
    target = Path(os.path.realpath(path))
    with named_after(path):
        if target.is_symlink():
            raise OSError(errno.ELOOP, "it is a symbolic link that leads to itself")
        if target.is_dir():
            raise IsADirectoryError(errno.EISDIR, "it is a directory")
        new = files.stage(target.parent)
        new.write_bytes(_bytes(text))
    return new, target


def refuse_way_out(path: Path) -> None:
    """Refuse to write through a link that leads out of its project: somebody else may have put it there.

    Raises:
        OSError: it is one.
    """
    if not path.is_symlink() or str(path).startswith(STREAMS):
        return
    try:
        Readable.of(path).require(path)
    except OutsideError as error:
        message = f"it is a link and {error.reason}; name that file itself if it is meant"
        raise PermissionError(errno.EACCES, message, str(path)) from error


def _take_over(old: Path, new: Path) -> None:
    """Give a file the permissions of the one that it replaces, and its owner as far as allowed.

    Raises:
        FileNotFoundError: there is none.
    """
    status, own = old.stat(), new.stat()
    if (status.st_uid, status.st_gid) != (own.st_uid, own.st_gid):
        with suppress(OSError):
            os.chown(new, status.st_uid, status.st_gid)
    new.chmod(status.st_mode & 0o777)
    with suppress(OSError, AttributeError):  # only Linux has them, and not in all file systems
        for name in os.listxattr(old):
            os.setxattr(new, name, os.getxattr(old, name))


def _write_into(path: Path, text: str | bytes) -> None:
    refuse_way_out(path)
    with named_after(path), path.open("wb") as stream:
        stream.write(_bytes(text))


def _bytes(text: str | bytes) -> bytes:
    """Encode a text in UTF-8; bytes stay as they are."""
    return text if isinstance(text, bytes) else text.encode()


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
