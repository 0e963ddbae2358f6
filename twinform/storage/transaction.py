"""Transactions: files and folders that are put into their places together, or not at all."""

import errno
import os
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from itertools import count
from pathlib import Path

from twinform.signals import undone
from twinform.storage.staging import StagingFolder


class Transaction:
    """Moves staged files to their places; `end` takes everything back unless `done` is set.

    Each step notes how it is taken back before it is made, and taking back looks at what is there. So it does not
    matter at which instruction an error or a signal comes, nor whether it comes while things are taken back.
    """

    def __init__(self) -> None:
        self.done = False
        self._undo: list[Callable[[], None]] = []
        self._rooms: list[StagingFolder] = []
        self._staged: dict[Path, Path] = {}
        self._folders: dict[Path, None] = {}
        self._numbers = count()

    def stage(self, folder: Path) -> Path:
        """Return a new path on the file system of a folder, for a file or folder to be moved into it.

        Raises:
            OSError: nothing can be written in the folder.
        """
        if folder not in self._staged:
            self.make(folder)
            room = StagingFolder(folder)
            self._rooms.append(room)
            self._undo.append(room.remove)
            self._staged[folder] = room.make()
        return self._staged[folder] / str(next(self._numbers))

    def make(self, folder: Path) -> None:
        """Make a folder and those above it, where they are missing.

        Raises:
            OSError: it cannot be made.
        """
        for each in reversed([*_missing(folder)]):
            # Undo steps are recorded before the step itself: a signal may come between any two
            # instructions.
            self._undo.append(each.rmdir)
            self._folders[each.parent] = None
            with suppress(FileExistsError):  # another process was faster
                each.mkdir()
        if not folder.is_dir():
            if os.path.lexists(folder):  # otherwise it would sound as if the file that is written were there
                raise NotADirectoryError(errno.ENOTDIR, "a file stands where its folder would be")
            raise FileNotFoundError(errno.ENOENT, "its folder was removed meanwhile")

    def move(self, new: Path, target: Path, *, keep: bool = True) -> None:
        """Move a staged file to its place; what was there can be put back, unless it need not be kept.

        Raises:
            OSError: it cannot be moved.
        """
        old = new.with_name(f"{new.name}.old")
        is_new = not os.path.lexists(target)
        # The old file keeps a second name until the last move has succeeded. Only a process that is
        # killed between two moves can leave some of the new files in place.
        if keep and not is_new:
            _give_second_name(target, old)
        self._undo.append(partial(_put_back, new, target, old, is_new=is_new))
        self._folders[target.parent] = None
        new.replace(target)

    def move_to_new(self, new: Path, target: Path) -> None:
        """Move a staged file to a place where nothing is.

        Raises:
            FileExistsError: something is there.
            OSError: it cannot be moved.
        """
        self._undo.append(partial(_take_away_link, new, target))
        self._folders[target.parent] = None
        try:
            # `link` fails if the target exists, which `rename` does not: nothing can be overwritten
            # in between.
            os.link(new, target)
        except FileExistsError:
            raise
        except OSError:  # there are no links, so for a moment another process may put something there
            if os.path.lexists(target):
                raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), str(target)) from None
            self.move(new, target)

    def take_away(self, target: Path, folder: Path) -> None:
        """Remove a file or link; `folder` is where something is staged for.

        Raises:
            OSError: it cannot be removed.
        """
        old = self.stage(folder)
        self._undo.append(partial(_put_back, old, target, old, is_new=False))
        target.rename(old)

    def sync(self) -> None:
        """Wait until the disk has the new names in all folders.

        Raises:
            OSError: the disk does not take them.
        """
        for folder in self._folders:
            with named_after(folder):
                _sync_folder(folder)

    def end(self) -> None:
        """Take back what was moved and made, unless the transaction is done, and remove all that was staged."""
        steps = [room.remove for room in self._rooms] if self.done else reversed(self._undo)
        for step in steps:
            _insist(step)


@contextmanager
def transaction() -> Generator[Transaction]:
    """A transaction that ends with the block, or with the program."""
    started = Transaction()
    with undone(started.end):
        yield started


@contextmanager
def named_after(path: Path) -> Generator[None]:
    """Put the final file name into an error: failed writes have none, and the staged name helps nobody."""
    try:
        yield
    except OSError as error:
        error.filename, error.filename2 = str(path), None
        raise


def _insist(step: Callable[[], None]) -> None:
    """Do a step, and retry once: a failed step must not keep the others from being undone."""
    try:
        step()
    except OSError:
        with suppress(OSError):
            step()


def _missing(folder: Path) -> Iterator[Path]:
    while not folder.exists():
        yield folder
        folder = folder.parent


def _put_back(new: Path, target: Path, old: Path, *, is_new: bool) -> None:
    if os.path.lexists(old):
        old.replace(target)
    elif is_new and not os.path.lexists(new):
        target.rename(new)


def _take_away_link(new: Path, target: Path) -> None:
    if new.exists() and target.exists() and new.samefile(target):
        target.unlink()


def _give_second_name(path: Path, name: Path) -> None:
    """Keep a file under another name before it is replaced: a hard link, or a copy where there are none."""
    import shutil  # noqa: PLC0415 - most files are new

    try:
        os.link(path, name)
    except OSError:
        copy = name.with_name(f"{name.name}.copy")
        shutil.copy2(path, copy, follow_symlinks=False)
        copy.replace(name)


def _sync_folder(folder: Path) -> None:
    try:
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError:  # it cannot be read, or is one of Windows, which has no descriptors of folders
        return
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno not in {errno.EINVAL, errno.ENOTSUP}:  # some file systems sync no folders
            raise
    finally:
        os.close(descriptor)
