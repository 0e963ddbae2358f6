"""Unpacks models from a tar or zip archive, which may be anybody's: within limits, and nothing leaves its folder."""

import os
import shutil
import stat
import tarfile
import time
import zipfile
import zlib
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from tempfile import mkdtemp
from typing import IO

from twinform.compiler.batch.entries import FolderError

MOST_FILES = 4_000_000
LEAST_BYTES = 2**30
"""What any archive may unpack to."""
MOST_TIMES = 100
"""An archive may unpack to so many times its own size; XML shrinks to a tenth or twentieth."""
_TOP = ".hg"
"""Marks a folder as the top of a repository: files are not looked for above it."""
_PIECE = 2**20
_LONGEST = 1024
_ENDINGS = (".zip", ".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tbz2", ".tar.xz", ".txz")


@dataclass(frozen=True, slots=True)
class _Member:
    """A file in an archive, and when it was written."""

    name: str
    time: float
    content: IO[bytes]


def is_archive(path: Path) -> bool:
    """Whether a path is that of an archive, by its name."""
    return path.name.lower().endswith(_ENDINGS) and not path.is_dir()


@contextmanager
def unpacked(archive: Path) -> Generator[Path]:
    """A folder with the regular files of an archive, each with its time, for as long as it is needed.

    Links, devices and the like are left out. Of two files of one name the last one counts, as tar has it.

    Raises:
        FolderError: it is no archive, is broken, holds too much, or a name in it leads out of it.
    """
    folder = Path(os.path.realpath(mkdtemp(prefix="twinform-batch-")))
    try:
        (folder / _TOP).touch()  # what is around the folder is none of the archive's business
        _unpack(archive, folder)
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _unpack(archive: Path, folder: Path) -> None:
    try:
        left = max(LEAST_BYTES, MOST_TIMES * archive.stat().st_size)
        members = _zip(archive) if archive.name.lower().endswith(".zip") else _tar(archive)
        for number, member in enumerate(members):
            _require_few(number, archive)
            path = folder / _place(member.name, archive)
            path.parent.mkdir(parents=True, exist_ok=True)
            left -= _write(member, path, left, archive)
    except FolderError:
        raise
    # zipfile raises ValueError, too, such as for names and times that are none
    except (tarfile.TarError, zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, ValueError) as error:
        raise FolderError(f"{archive} cannot be unpacked: {error}") from error
    except OSError as error:
        raise FolderError(f"{archive} cannot be unpacked: {error.strerror or error}") from error


def _require_few(number: int, archive: Path) -> None:
    if number >= MOST_FILES:
        raise FolderError(f"{archive} has more than {MOST_FILES:,} files")


def _write(member: _Member, path: Path, left: int, archive: Path) -> int:
    """Write a file; gives its size. The size in its header is not believed."""
    size = 0
    path.unlink(missing_ok=True)
    with path.open("xb") as file:
        while piece := member.content.read(_PIECE):
            size += len(piece)
            if size > left:
                raise FolderError(f"{archive} unpacks to more than {MOST_TIMES} times its size")
            file.write(piece)
    os.utime(path, (member.time, member.time))
    return size


def _place(name: str, archive: Path) -> PurePosixPath:
    path = PurePosixPath(name)
    strange = "\\" in name or "\0" in name or ":" in path.parts[0] if path.parts else True
    if strange or path.is_absolute() or ".." in path.parts or len(name) > _LONGEST:
        raise FolderError(f"{archive} is not unpacked: the name {name!r} in it leads out of it, or is none everywhere")
    return path


def _tar(archive: Path) -> Iterator[_Member]:
    with tarfile.open(archive, errors="surrogateescape") as tar:
        for each in tar:
            tar.members = []  # type: ignore[misc] - it remembers all, and there may be millions
            content = tar.extractfile(each) if each.isreg() else None
            if content is not None:
                yield _Member(each.name, max(0.0, float(each.mtime)), content)


def _zip(archive: Path) -> Iterator[_Member]:
    with zipfile.ZipFile(archive) as file:
        for each in file.infolist():
            kind = stat.S_IFMT(each.external_attr >> 16)
            # ZipInfo.is_dir raises for a member whose name is empty
            if not each.filename.endswith("/") and kind in {0, stat.S_IFREG}:
                with file.open(each) as content:
                    yield _Member(each.orig_filename, _time(each), content)


def _time(info: zipfile.ZipInfo) -> float:
    try:
        return time.mktime((*info.date_time, 0, 0, -1))
    except (ValueError, OverflowError):
        return 0.0
