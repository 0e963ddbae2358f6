"""Unpacks models from a tar or zip archive, which may be anybody's: within limits, and nothing leaves its folder."""

import hashlib
import io
import lzma
import os
import stat
import struct
import time
import zipfile
import zlib
from collections.abc import Generator, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import field
from pathlib import Path, PurePosixPath

from twinform.compiler.batch.entries import FolderError
from twinform.compiler.batch.tar_reader import BrokenArchiveError, ByteStream, LargeArchiveError, members, opened
from twinform.dataclass import dataclass
from twinform.file_access import Readable
from twinform.storage.staging import staging_folder, temporary_folder

LEAST_FILES = 5_000
"""Files and folders that any archive may have."""
BYTES_PER_FILE = 200
"""For so many of its own bytes an archive may have one more; a small compressed model takes twice as much."""
LEAST_BYTES = 2**28
"""Bytes that any archive may unpack to."""
MOST_TIMES = 100
"""An archive may unpack to so many times its own size; XML shrinks to a tenth or twentieth."""
# The most headers that a file in a tar archive has: its own, and two for a long name or its
# attributes.
_HEADERS = 3
_TOP = ".hg"
"""Marks a folder as the top of a repository: files are not looked for above it."""
_PIECE = 2**20
_LONGEST = 1024
_DEEPEST = 64
# Seconds since 1970. A file time beyond it is nonsense, and an error on some systems.
_LATEST = 2**33
# Bytes of a zip archive's list of files that are read in any case: `zipfile` keeps all of it in
# memory.
_DIRECTORY = 2**22
# The methods that zip archives are made with. LZMA is not among them, and asks for up to 4 GiB of
# memory.
_METHODS = frozenset({zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2})
_ENDINGS = (".zip", ".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tbz2", ".tar.xz", ".txz")
_ADVICE = "unpack it yourself if this is meant, and name the folder"


@dataclass(frozen=True, slots=True)
class _Member:
    """A file in an archive, and when it was written."""

    name: str
    time: float
    content: ByteStream


def is_archive(path: Path) -> bool:
    """Return whether a path has the name of an archive."""
    return path.name.lower().endswith(_ENDINGS) and not path.is_dir()


@dataclass(frozen=True, slots=True)
class Unpacked:
    """The folder that an archive was unpacked to, and the digest of each file by its path there."""

    folder: Path
    contents: Mapping[str, str]


@contextmanager
def unpacked(archive: Path) -> Generator[Unpacked]:
    """Unpack the regular files of an archive into a temporary folder, and yield that.

    The times in an archive prove nothing about its files, and the status of unpacked files is new each time, so the
    digests are computed here. Links, devices and the like are left out. Of two files with one name the last one counts,
    as in tar.

    Raises:
        FolderError: it is no archive, is broken, holds too much, or a name in it leads out of it.
    """
    with staging_folder(temporary_folder()) as folder:
        (folder / _TOP).touch()  # what is around the folder is none of the archive's business
        yield Unpacked(folder, _unpack(archive, folder))


def _unpack(archive: Path, folder: Path) -> dict[str, str]:
    """Write all files and return their digests."""
    try:
        Readable.of(archive).read(archive, 0)  # the readers of archives would wait for a pipe, and follow any link
        room = _UnpackingFolder.of(archive, folder)
        for member in _read_zip(archive, room) if archive.name.lower().endswith(".zip") else _read_tar(archive, room):
            room.write(member)
    except OSError as error:
        raise FolderError(f"{archive} cannot be unpacked: {error.strerror or error}") from error
    except LargeArchiveError as error:
        raise FolderError(f"{archive} is not unpacked: {error}; {_ADVICE}") from error
    except _FAULTS as error:
        raise FolderError(f"{archive} cannot be unpacked: {error}") from error
    return room.contents


_FAULTS = (ValueError, zipfile.BadZipFile, zlib.error, lzma.LZMAError, struct.error, EOFError, RuntimeError)
"""What the readers of archives and of compressed data raise."""


@dataclass(slots=True)
class _UnpackingFolder:
    """The folder that an archive is unpacked to, and how much may still be written there."""

    folder: Path
    most_bytes: int
    most_files: int
    contents: dict[str, str] = field(default_factory=dict[str, str])
    _bytes: int = 0
    _files: int = 0

    @classmethod
    def of(cls, archive: Path, folder: Path) -> "_UnpackingFolder":
        size = archive.stat().st_size
        return cls(folder, max(LEAST_BYTES, MOST_TIMES * size), LEAST_FILES + size // BYTES_PER_FILE)

    def write(self, member: _Member) -> None:
        """Write a file. The size in its header is not believed."""
        place, digest = _check_name(member.name), hashlib.sha256()
        path = self.folder / place
        try:
            self._make_folder(path.parent)
            self._count_file()
            # As tar has it, the last file of a name counts; unlinked first, since "xb" refuses what
            # is there and never writes through a link.
            path.unlink(missing_ok=True)
            with path.open("xb") as file:
                while piece := member.content.read(_PIECE):
                    # Sizes in headers are believed where they are too large, and never otherwise.
                    self._bytes += len(piece)
                    if self._bytes > self.most_bytes:
                        raise LargeArchiveError(
                            f"with {member.name!r} in it, it unpacks to more than {self.most_bytes:,} bytes"
                        )
                    digest.update(piece)
                    file.write(piece)
        except (FileExistsError, IsADirectoryError, NotADirectoryError) as error:
            raise BrokenArchiveError(f"{member.name!r} is a file in it, and a folder as well") from error
        self.contents[str(place)] = digest.hexdigest()
        written = member.time if 0 <= member.time < _LATEST else 0.0
        os.utime(path, (written, written))

    def _make_folder(self, folder: Path) -> None:
        missing: list[Path] = []
        while not folder.is_dir():
            missing.append(folder)
            folder = folder.parent
        for each in reversed(missing):
            self._count_file()
            each.mkdir()

    def _count_file(self) -> None:
        self._files += 1
        if self._files > self.most_files:
            raise LargeArchiveError(f"it has more than {self.most_files:,} files and folders")


def _check_name(name: str) -> PurePosixPath:
    path = PurePosixPath(name)
    # A backslash separates folders on Windows, and `C:` or `name:stream` mean other places there.
    strange = "\\" in name or "\0" in name or ":" in path.parts[0] if path.parts else True
    if strange or path.is_absolute() or ".." in path.parts:
        raise BrokenArchiveError(f"the name {name[:_LONGEST]!r} in it leads out of it, or is none everywhere")
    if len(name) > _LONGEST or len(path.parts) > _DEEPEST:
        raise BrokenArchiveError(
            f"a name in it has more than {_LONGEST} letters or {_DEEPEST} folders: {name[:50]!r}..."
        )
    return path


def _read_tar(archive: Path, room: _UnpackingFolder) -> Iterator[_Member]:
    with opened(archive) as stream:
        for each in members(stream, room.most_bytes, _HEADERS * room.most_files):
            yield _Member(each.name, each.time, each)


class _BoundedZip(io.BufferedReader):
    """A zip archive that limits how much is read at once: `zipfile` reads the list of files as a whole."""

    def __init__(self, archive: Path) -> None:
        super().__init__(io.FileIO(archive))
        self._most = max(_DIRECTORY, archive.stat().st_size // 10)

    def read(self, size: int | None = -1, /) -> bytes:
        if size is not None and size > self._most:
            raise LargeArchiveError(f"its list of files has more than {self._most:,} bytes")
        return super().read(size)


def _read_zip(archive: Path, room: _UnpackingFolder) -> Iterator[_Member]:
    with _BoundedZip(archive) as data, zipfile.ZipFile(data) as file:
        listed = file.infolist()
        if sum(each.file_size for each in listed) > room.most_bytes:
            raise LargeArchiveError(f"it unpacks to more than {room.most_bytes:,} bytes")
        for each in listed:
            kind = stat.S_IFMT(each.external_attr >> 16)
            # ZipInfo.is_dir raises for a member whose name is empty
            if each.filename.endswith("/") or kind not in {0, stat.S_IFREG}:
                continue
            if each.compress_type not in _METHODS:
                raise BrokenArchiveError(f"{each.orig_filename!r} in it is compressed in a way that is not read here")
            with file.open(each) as content:
                yield _Member(each.orig_filename, _read_time(each), content)


def _read_time(info: zipfile.ZipInfo) -> float:
    try:
        return time.mktime((*info.date_time, 0, 0, -1))
    except (ValueError, OverflowError):
        return 0.0
