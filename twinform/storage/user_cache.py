"""The cache folder of the user, where results of earlier runs are kept, and which folders are trusted to have ours."""

import os
import stat
from contextlib import suppress
from pathlib import Path

from twinform.file_access import REPOSITORY, has_any
from twinform.storage.staging import mark_of
from twinform.storage.writing import write_atomically

_OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH


def user_cache(kind: str) -> Path | None:
    """Return the folder for results of a kind, as the XDG base directories have it; None where the user has no home."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    try:
        home = Path(base) if Path(base).is_absolute() else Path.home() / ".cache"
    except RuntimeError:
        return None
    return home / "twinform" / kind


def open_own_folder(folder: Path) -> Path | None:
    """Make a folder for results, and return it; None where others may have written what is in it.

    In a repository, results lie in a folder whose name is the inode number of the one around it. So what came along
    with the repository, or was copied there, is never read. A `.gitignore` keeps git from taking the folder along.
    """
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not _is_own(folder):
            return None
        if not any(has_any(each, REPOSITORY) for each in folder.absolute().parents):
            return folder
        if not (folder / ".gitignore").is_file():
            write_atomically(folder / ".gitignore", "*\n", durably=False)
        inner = folder / mark_of(folder.stat())
        inner.mkdir(mode=0o700, exist_ok=True)
    except OSError:
        return None
    return inner if _is_own(inner) else None


def _is_own(folder: Path) -> bool:
    """Whether a folder belongs to the user, who alone may write into it, and is no link to another one."""
    status = folder.lstat()
    if not stat.S_ISDIR(status.st_mode):
        return False
    return not hasattr(os, "getuid") or (status.st_uid == os.getuid() and not status.st_mode & _OTHERS_WRITE)


def prune(folder: Path, most: int) -> None:
    """Delete the files of a folder that were used longest ago, beyond so many bytes."""
    found = [(status.st_mtime, status.st_size, path) for path in folder.iterdir() for status in [path.stat()]]
    total = sum(size for _, size, _ in found)
    for _, size, path in sorted(found):
        if total <= most:
            return
        with suppress(OSError):
            path.unlink()
            total -= size
