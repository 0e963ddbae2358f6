"""Atomic file output: no reader sees half a file, and of several files all are written or none."""

import errno
import os
import shutil
import tempfile
from collections.abc import Callable, Generator, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

from twinform.compiler.output.same_files import is_stream

_PREFIX = 64
"""So much of its name has a file that is being written, which must not be longer than the name that it will have."""


def write_atomically(path: str | Path, text: str | bytes) -> None:
    """Put the text where `path` is, all of it or nothing: it is written beside it and then moved over it.

    Folders that are missing are made. The permissions of a file that is replaced stay. A symbolic link is followed. A
    pipe or device is written into.

    Raises:
        OSError: the text could not be written; the old file is untouched.
    """
    write_all_atomically({Path(path): text})


def write_all_atomically(
    texts: Mapping[Path, str | bytes], then: Callable[[], None] | None = None, *, durably: bool = True
) -> None:
    """Put every text in its place once all of them are written beside it; folders that are missing are made.

    `then` is called when nothing but moving them is left to do. Where that, or one of the moves, fails, those that were
    moved already are taken back. `durably` waits until the disk has them, so that not even a power cut leaves half a
    file in a place.

    Raises:
        OSError: one of them could not be written; the old files are as they were.
    """
    staged = _Staged()
    try:
        for path, text in texts.items():
            if not is_stream(path):
                staged.add(path, text, durably=durably)
        for path, text in texts.items():
            if is_stream(path):
                _write_into(path, text)
        if then:
            then()
        staged.move()
    except BaseException:
        staged.take_back()
        raise
    finally:
        staged.clean_up()


@dataclass(slots=True)
class _File:
    """A text on its way: written beside its target, which may have an old file with another name besides."""

    temporary: Path
    target: Path
    old: Path | None = None

    @property
    def is_moved(self) -> bool:
        return not self.temporary.exists()


@dataclass(slots=True)
class _Staged:
    """Files that are complete and not yet in their places, and the folders that were made for them."""

    files: list[_File] = field(default_factory=list[_File])
    folders: list[Path] = field(default_factory=list[Path])

    def add(self, path: Path, text: str | bytes, *, durably: bool) -> None:
        target = Path(os.path.realpath(path))
        with _named_after(path):
            if target.is_symlink():
                raise OSError(errno.ELOOP, "it is a symbolic link that leads to itself")
            if target.is_dir():
                raise IsADirectoryError(errno.EISDIR, "it is a directory")
            self._make(target.parent)
        self.files.append(_File(_written_beside(target, text, durably=durably), target))

    def move(self) -> None:
        """Put all in their places; the old files are kept until all are there, unless there is only one."""
        for each in self.files if len(self.files) > 1 else ():
            with _named_after(each.target):
                each.old = _second_name(each.target)
        for each in self.files:
            with _named_after(each.target):
                each.temporary.replace(each.target)

    def take_back(self) -> None:
        """Put the old files where they were, and take away what was new."""
        for each in reversed(self.files):
            with suppress(OSError):
                if each.is_moved and each.old:
                    each.old.replace(each.target)
                elif each.is_moved and len(self.files) > 1:
                    each.target.unlink()
                else:
                    each.temporary.unlink(missing_ok=True)
        for folder in reversed(self.folders):
            with suppress(OSError):  # somebody else has put something into it
                folder.rmdir()

    def clean_up(self) -> None:
        for each in self.files:
            if each.old:
                with suppress(OSError):
                    each.old.unlink(missing_ok=True)

    def _make(self, folder: Path) -> None:
        try:
            for each in reversed([*_missing(folder)]):
                with suppress(FileExistsError):  # another process was faster
                    each.mkdir()
                    self.folders.append(each)
            folder.mkdir(exist_ok=True)  # raises if it is a file
        except FileExistsError as error:  # which would sound as if the file that is written were there
            raise NotADirectoryError(errno.ENOTDIR, "a file stands where its folder would be") from error


def _missing(folder: Path) -> Iterator[Path]:
    while not folder.exists():
        yield folder
        folder = folder.parent


def _write_into(path: Path, text: str | bytes) -> None:
    with _named_after(path), path.open("wb") as stream:
        stream.write(_bytes(text))


def _bytes(text: str | bytes) -> bytes:
    """What is written: a text in UTF-8."""
    return text if isinstance(text, bytes) else text.encode()


@contextmanager
def _named_after(path: Path) -> Generator[None]:
    """Name the file that an error is about: a failed write does not know, and that of a temporary file helps nobody."""
    try:
        yield
    except OSError as error:
        error.filename, error.filename2 = str(path), None
        raise


def _written_beside(path: Path, text: str | bytes, *, durably: bool) -> Path:
    """The text in a file beside the one that it is for."""
    mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~_umask()
    temporary, descriptor = _new_beside(path)
    try:
        with _named_after(path), os.fdopen(descriptor, "wb") as file:
            file.write(_bytes(text))
            file.flush()
            if durably:
                os.fsync(file.fileno())
        temporary.chmod(mode)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise
    return temporary


def _new_beside(path: Path) -> tuple[Path, int]:
    with _named_after(path):
        descriptor, name = tempfile.mkstemp(prefix=f".{path.name[:_PREFIX]}.", dir=path.parent)
    return Path(name), descriptor


def _second_name(path: Path) -> Path | None:
    """Another name of a file, by which it stays when something is moved over it; a copy where there are no links."""
    if not path.exists():
        return None
    name, descriptor = _new_beside(path)
    os.close(descriptor)
    try:
        with suppress(OSError):
            name.unlink()
            os.link(path, name)
            return name
        shutil.copy2(path, name)
    except BaseException:
        with suppress(OSError):
            name.unlink()
        raise
    return name


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
