"""Staging folders: where files are written before they are moved to their places, and what is left of killed runs.

A staging folder lies beside the files that it is for, so that moving them is one step of the file system. The process
that has made it holds a lock on it. The lock of a process that was killed is gone, and so the next run that writes
there knows which folders nobody needs any more.
"""

import errno
import os
from collections.abc import Generator
from contextlib import contextmanager, suppress
from pathlib import Path

from twinform.signals import undone

try:
    import fcntl
except ImportError:  # on Windows; there is no telling whose folder it is, so none is removed
    fcntl = None

# Linux can write a file without a name (O_TMPFILE) and link it at the end, so that a killed process
# leaves nothing. That cannot replace an existing file, keeps a descriptor open for each file, and
# folders, other file systems and other operating systems would need a staging folder all the same.
PREFIX = ".twinform-staging-"
"""What the names of all staging folders begin with."""
_TRIES = 10
_searched: set[Path] = set()


class StagingFolder:
    """A folder inside `parent` for this process alone."""

    def __init__(self, parent: Path) -> None:
        self._parent = parent
        self._outer: Path | None = None
        self._lock: int | None = None

    def make(self) -> Path:
        """Make the folder, after removing what killed processes have left beside it.

        Raises:
            OSError: it cannot be made.
        """
        remove_leftovers(self._parent)
        for _ in range(_TRIES):
            # the name is known before there is a folder of it, and so is what `remove` has to look for
            self._outer = self._parent / f"{PREFIX}{os.urandom(8).hex()}"
            self._outer.mkdir(mode=0o700)
            with suppress(FileNotFoundError):  # another run has taken it for one that is left, before it had its lock
                # The kernel releases the lock however the process ends. A process ID in the name
                # would be wrong on a network file system, and an age wherever a clock was set back.
                self._lock = _locked(self._outer)
                inner = self._outer / mark_of(self._outer.stat())
                inner.mkdir()
                return inner
        raise FileNotFoundError(errno.ENOENT, "folders disappear as soon as they are made", str(self._parent))

    def remove(self) -> None:
        """Remove the folder with all that is in it. It may be called again."""
        import shutil  # noqa: PLC0415 - it brings three kinds of compression along

        if self._outer is not None:
            shutil.rmtree(self._outer, ignore_errors=True)
            if os.path.lexists(self._outer):  # once more: an error may have passed
                shutil.rmtree(self._outer, ignore_errors=True)
        if self._lock is not None:
            with suppress(OSError):
                os.close(self._lock)
            self._lock = None


def temporary_folder() -> Path:
    """The folder for temporary files, without symbolic links on the way to it.

    Raises:
        FileNotFoundError: nothing can be written in any folder that there is for them.
    """
    from tempfile import gettempdir  # noqa: PLC0415 - most commands need none

    try:
        return Path(os.path.realpath(gettempdir()))
    except FileNotFoundError as error:  # which has no name
        message = "nothing can be written in any folder for temporary files"
        raise FileNotFoundError(errno.ENOENT, message, "TMPDIR") from error


@contextmanager
def staging_folder(parent: Path) -> Generator[Path]:
    """A new folder in `parent` for as long as the block lasts.

    Raises:
        OSError: it cannot be made.
    """
    folder = StagingFolder(parent)
    with undone(folder.remove):
        yield folder.make()


def remove_leftovers(folder: Path) -> None:
    """Remove the staging folders that killed processes of the same user have left in a folder.

    Each folder is searched once by a process. What only looks like a staging folder stays: one that is a link, belongs
    to another user, is in use, or has not the content that this module gives it.
    """
    if fcntl is None or folder in _searched:
        return
    _searched.add(folder)
    with suppress(OSError):  # it cannot be read
        for name in os.listdir(folder):  # noqa: PTH208 - there may be many
            if name.startswith(PREFIX):
                with suppress(OSError):
                    _remove_if_left(folder / name)


def _remove_if_left(path: Path) -> None:
    import shutil  # noqa: PLC0415 - it brings three kinds of compression along

    lock = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        status = os.fstat(lock)
        # Only what this module could have made is removed: a link is refused by O_NOFOLLOW, and an
        # unpacked archive or a copy does not contain the right mark.
        if status.st_uid == os.geteuid() and fcntl is not None:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)  # raises where the folder is in use
            if os.listdir(lock) in ([], [mark_of(status)]):  # noqa: PTH208 - of a descriptor
                shutil.rmtree(path)
    finally:
        os.close(lock)


def _locked(folder: Path) -> int | None:
    """Return a descriptor that holds a folder's lock; None if the system has no such locks.

    Raises:
        FileNotFoundError: another process holds it, and is about to remove the folder.
    """
    if fcntl is None:
        return None
    lock = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        os.close(lock)
        raise FileNotFoundError(errno.ENOENT, "it is being removed") from error
    except OSError:  # some network file systems lock no folders: then nobody else can lock it either
        pass
    return lock


def mark_of(status: os.stat_result) -> str:
    """Return the name of the single folder inside a staging folder: the inode number of the latter.

    Nobody knows that number before the folder is there. So no archive and no repository can bring along what passes for
    a staging folder, and a copy of one does not pass for it either.
    """
    return f"{status.st_dev:x}-{status.st_ino:x}"
