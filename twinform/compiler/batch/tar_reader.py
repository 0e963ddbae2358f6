"""Reads tar archives forward, member by member, without believing what they say about their sizes.

`tarfile` reads an extended header as a whole, whatever its size, and some versions of Python search it for records in
quadratic time. So `tarfile` only decodes the blocks of fixed size here.
"""

import bz2
import gzip
import lzma
import tarfile
from collections.abc import Generator, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Protocol

from twinform.dataclass import dataclass

# 3 MB that unpack to a header of 3 GiB take 3.2 GB of memory in `tarfile`, which also follows chains of headers by
# recursion and ends at a broken header as if the archive ended there. Of the 52 hostile archives of the tests, the
# standard library with its `data` filter takes more than 1 GiB or 5 s for 9, and safe-unzip 0.2 more than 5 s for 4; it
# does not read bzip2 and xz.
LONGEST_HEADER = 2**20
"""Bytes of an extended header; the largest real ones, with extended attributes of files, have 64 KiB."""
XZ_MEMORY = 2**27
"""Bytes that a dictionary of xz may take; `xz -9` needs half of that."""
_BLOCK = tarfile.BLOCKSIZE
_PIECE = 2**20
_EXTENDED = (tarfile.XHDTYPE, tarfile.SOLARIS_XHDTYPE)
_SPARSE_RECORD = b"GNU.sparse."
_LONGEST_LENGTH = 20
"""Digits of the length of a record."""
_ENCODING, _ERRORS = "utf-8", "surrogateescape"


class BrokenArchiveError(ValueError):
    """An archive is broken, or has a kind of file that is not read."""


class LargeArchiveError(BrokenArchiveError):
    """An archive holds more than is allowed."""


class ByteStream(Protocol):
    """A stream that can be read forward."""

    def read(self, size: int, /) -> bytes:
        """Return at most so many bytes; none at the end."""
        ...


@dataclass(slots=True)
class TarMember:
    """A regular file in an archive, which can be read until the next member is asked for."""

    name: str
    time: float
    size: int
    _source: "_BoundedStream"
    _left: int

    def read(self, size: int) -> bytes:
        """Return the next bytes of the content; none at its end.

        Raises:
            BrokenArchiveError: the archive ends before it.
        """
        piece = self._source.read(min(size, self._left))
        if self._left and not piece:
            raise BrokenArchiveError(f"it ends in the middle of {self.name!r}")
        self._left -= len(piece)
        return piece

    def skip(self) -> None:
        """Read on to the next header."""
        while self.read(_PIECE):
            pass
        self._source.read(-self.size % _BLOCK)


@contextmanager
def opened(archive: Path) -> Generator[ByteStream]:
    """Open the decompressed stream of an archive, which its first bytes tell: gzip, bzip2, xz or none."""
    with archive.open("rb") as file:
        beginning = file.read(6)
        file.seek(0)
        if beginning.startswith(b"\x1f\x8b"):
            with gzip.open(file) as unpacked:
                yield unpacked
        elif beginning.startswith(b"BZh"):
            with bz2.open(file) as unpacked:
                yield unpacked
        elif beginning.startswith(b"\xfd7zXZ\0"):
            yield _XzStream(file)
        else:
            yield file


def members(stream: ByteStream, most_bytes: int, most_headers: int) -> Iterator[TarMember]:
    """Yield the regular files of an archive in order, without links, devices and folders.

    Raises:
        LargeArchiveError: it unpacks to more bytes, or has more headers, than it may.
        BrokenArchiveError: it is broken, or has a kind of file that is not read here.
    """
    source, name, records = _BoundedStream(stream, most_bytes), "", dict[bytes, bytes]()
    for _ in range(most_headers):
        info = _read_header(source)
        if info is None:
            return
        if info.type in {*_EXTENDED, tarfile.XGLTYPE, tarfile.GNUTYPE_LONGNAME, tarfile.GNUTYPE_LONGLINK}:
            content = _read_extension(source, info)
            if info.type in _EXTENDED:
                records.update(_parse_records(content))
            elif info.type == tarfile.GNUTYPE_LONGNAME:
                name = content.partition(b"\0")[0].decode(_ENCODING, _ERRORS)
            continue
        member = _make_member(source, info, name, records)
        # links, devices and folders have no content, whatever their size says
        filled = info.isreg() or info.type not in tarfile.SUPPORTED_TYPES
        if filled:
            source.expect(member.size)
        if info.isreg():
            yield member
        if filled:
            member.skip()
        name, records = "", {}
    raise LargeArchiveError(f"it has more than {most_headers:,} headers")


def _read_header(source: "_BoundedStream") -> tarfile.TarInfo | None:
    """Return the next block as a header; None at the end."""
    block = source.read(_BLOCK)
    if not block.strip(b"\0"):
        if not source.count:
            raise BrokenArchiveError("it is empty")
        return None
    try:
        return tarfile.TarInfo.frombuf(block, _ENCODING, _ERRORS)
    except tarfile.HeaderError as error:
        raise BrokenArchiveError(f"there is no header at byte {source.count - len(block):,} ({error})") from error


def _read_extension(source: "_BoundedStream", info: tarfile.TarInfo) -> bytes:
    """Return the content of an extended header."""
    if not 0 <= info.size <= LONGEST_HEADER:
        raise BrokenArchiveError(f"the extended header {info.name!r} in it has more than {LONGEST_HEADER >> 20} MiB")
    content = source.exactly(info.size)
    source.exactly(-info.size % _BLOCK)
    return content


def _parse_records(content: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Yield the records of an extended header, each of which begins with its own length."""
    start = 0
    while start < len(content) and content[start]:
        blank = content.find(b" ", start, start + _LONGEST_LENGTH)
        end = start + int(content[start:blank]) if blank > 0 and content[start:blank].isdigit() else 0
        if not start <= blank < end <= len(content):
            raise BrokenArchiveError("an extended header in it has a record of no length")
        key, _, value = content[blank + 1 : end - 1].partition(b"=")
        yield key, value
        start = end


def _make_member(
    source: "_BoundedStream", info: tarfile.TarInfo, name: str, records: Mapping[bytes, bytes]
) -> TarMember:
    name = name or records.get(b"path", b"").decode(_ENCODING, _ERRORS) or info.name
    # No model needs sparse files, and a few bytes of one stand for any number of zeros.
    if info.type == tarfile.GNUTYPE_SPARSE or any(key.startswith(_SPARSE_RECORD) for key in records):
        raise BrokenArchiveError(f"{name!r} in it is stored without its holes: make the archive without --sparse")
    size = _find_number(records, b"size", info.size)
    if not 0 <= size < 2**63:
        raise BrokenArchiveError(f"{name!r} in it has the size {size}")
    return TarMember(name, _find_number(records, b"mtime", info.mtime), int(size), source, int(size))


def _find_number(records: Mapping[bytes, bytes], key: bytes, usual: float) -> float:
    value = records.get(key)
    if value is None:
        return usual
    try:
        return int(value) if value.isdigit() else float(value)
    except ValueError as error:
        raise BrokenArchiveError(f"the {key.decode()} of an extended header in it is no number") from error


class _BoundedStream:
    """A stream that counts the bytes that are read, up to a limit."""

    def __init__(self, stream: ByteStream, most: int) -> None:
        self._stream, self._most = stream, most
        self.count = 0

    def read(self, size: int) -> bytes:
        """Return so many bytes, or all that are left; a stream of the standard library may return fewer at a time."""
        pieces: list[bytes] = []
        while size and (piece := self._stream.read(size)):
            pieces.append(piece)
            size -= len(piece)
            self.count += len(piece)
        self.expect(0)
        return b"".join(pieces)

    def expect(self, size: int) -> None:
        """Raise if so many more bytes would exceed the limit."""
        if self.count + size > self._most:
            raise LargeArchiveError(f"it unpacks to more than {self._most:,} bytes")

    def exactly(self, size: int) -> bytes:
        """Return exactly so many bytes.

        Raises:
            BrokenArchiveError: there are fewer.
        """
        found = self.read(size)
        if len(found) < size:
            raise BrokenArchiveError("it ends in the middle of a header")
        return found


class _XzStream:
    """The decompressed bytes of xz; `lzma.open` has no limit on the memory of its dictionary."""

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file
        self._decompressor = lzma.LZMADecompressor(memlimit=XZ_MEMORY)

    def read(self, size: int) -> bytes:
        """Return at most so many bytes; none at the end."""
        while True:
            if self._decompressor.eof and not self._next_stream():
                return b""
            data = self._file.read(_PIECE) if self._decompressor.needs_input else b""
            found = self._decompressor.decompress(data, size)
            if found:
                return found
            if self._decompressor.needs_input and not data and not self._decompressor.eof:
                raise EOFError("the compressed data end too early")

    def _next_stream(self) -> bool:
        """Go on with the next stream of the file, with zeros before it if any; return whether there is one."""
        rest = self._decompressor.unused_data.lstrip(b"\0")
        while not rest:
            piece = self._file.read(_PIECE)
            if not piece:
                return False
            rest = piece.lstrip(b"\0")
        self._file.seek(-len(rest), 1)
        self._decompressor = lzma.LZMADecompressor(memlimit=XZ_MEMORY)
        return True
