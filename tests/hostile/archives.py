"""Archives that cost far more than their size, lie about it, or lead out of their folder: made anew each time."""

import bz2
import gzip
import io
import lzma
import struct
import tarfile
import zipfile
import zlib
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from pathlib import Path

_BLOCK = 512
_MEBIBYTE = 2**20
_GOOD = b'<robot name="good"><link name="base"/></robot>'


@cache
def _zeros(mebibytes: int) -> bytes:
    """So many MiB of zeros in gzip, as several streams one behind the other."""
    return gzip.compress(bytes(16 * _MEBIBYTE), 1) * (mebibytes // 16)


def _header(name: str, kind: bytes = tarfile.REGTYPE, size: int = 0, link: str = "") -> bytes:
    info = tarfile.TarInfo(name)
    info.type, info.size, info.linkname = kind, size, link
    return info.tobuf(tarfile.GNU_FORMAT)


def _padded(content: bytes) -> bytes:
    return content + bytes(-len(content) % _BLOCK)


def _file(name: str, content: bytes = _GOOD) -> bytes:
    return _header(name, size=len(content)) + _padded(content)


def _pax(content: bytes, kind: bytes = tarfile.XHDTYPE) -> bytes:
    return _header("pax", kind, len(content)) + _padded(content)


def _record(key: str, value: str) -> bytes:
    rest = f" {key}={value}\n".encode()
    length = len(rest)
    while len(str(length)) + len(rest) != length:
        length = len(str(length)) + len(rest)
    return str(length).encode() + rest


def _end(*parts: bytes) -> bytes:
    return b"".join((*parts, bytes(2 * _BLOCK)))


def _tgz(*parts: bytes) -> bytes:
    return gzip.compress(_end(*parts), 1)


def _huge(kind: bytes) -> bytes:
    """An extended header of 3 GiB."""
    return gzip.compress(_header("long", kind, 3 * 2**30)) + _zeros(3 * 1024) + gzip.compress(_file("a.urdf"))


def _numbered(count: int, kind: bytes = tarfile.REGTYPE) -> bytes:
    """So many members without content, whose headers differ in the name only."""
    first = _header("0" * 8, kind)
    rest = sum(first) - 8 * ord("0") - sum(first[148:156]) + 8 * ord(" ")
    blocks: list[bytes] = []
    for number in range(count):
        name = f"{number:08}".encode()
        checksum = f"{rest + sum(name):06o}\0 ".encode()
        blocks.append(name + first[8:148] + checksum + first[156:])
    return b"".join(blocks)


def _xz_with_dictionary() -> bytes:
    """A file in xz that asks for a dictionary of 1.5 GiB, which it does not need."""
    filters = [{"id": lzma.FILTER_LZMA2, "dict_size": 2**16}]
    made = bytearray(lzma.compress(_end(_file("a.urdf")), lzma.FORMAT_XZ, lzma.CHECK_CRC32, filters=filters))
    block = slice(12, 12 + (made[12] + 1) * 4)
    header = made[block]
    header[header.index(0x21) + 2] = 37  # the size of the dictionary, in steps of half a power of two
    header[-4:] = struct.pack("<I", zlib.crc32(header[:-4]))
    made[block] = header
    return bytes(made)


def zipped(entries: Iterable[tuple[str, bytes]], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    """A zip archive with these entries."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", method) as archive:
        for name, content in entries:
            archive.writestr(zipfile.ZipInfo(name), content, method)
    return file.getvalue()


def _overlapping(count: int, size: int) -> bytes:
    """A zip archive in which all entries have one and the same content."""
    plain = zipped([("0.urdf", bytes(size))])
    at = plain.rindex(b"PK\x01\x02")
    end = plain.rindex(b"PK\x05\x06")
    entries = b"".join(plain[at : at + 46] + f"{number:06}".encode() for number in range(count))
    return (
        plain[:at]
        + entries
        + struct.pack("<4s4H2IH", b"PK\x05\x06", 0, 0, count & 0xFFFF, count & 0xFFFF, len(entries), at, 0)
        + plain[end + 22 :]
    )


def _patched(archive: bytes, signature: bytes, at: int, value: bytes) -> bytes:
    place = archive.rindex(signature) + at
    return archive[:place] + value + archive[place + len(value) :]


_ODD_NAMES = {
    "up": "../up.urdf", "root": "/tmp/root.urdf", "middle": "a/../../up.urdf", "backslash": "a\\..\\up.urdf",
    "drive": "C:up.urdf",
}  # fmt: skip

REFUSED: Mapping[str, tuple[str, Callable[[], bytes], str]] = {
    "a PAX header of 3 GiB": ("a.tgz", lambda: _huge(tarfile.XHDTYPE), "more than 1 MiB"),
    "a global header of 3 GiB": ("a.tgz", lambda: _huge(tarfile.XGLTYPE), "more than 1 MiB"),
    "a Solaris header of 3 GiB": ("a.tgz", lambda: _huge(tarfile.SOLARIS_XHDTYPE), "more than 1 MiB"),
    "a GNU name of 3 GiB": ("a.tgz", lambda: _huge(tarfile.GNUTYPE_LONGNAME), "more than 1 MiB"),
    "a GNU link of 3 GiB": ("a.tgz", lambda: _huge(tarfile.GNUTYPE_LONGLINK), "more than 1 MiB"),
    "a PAX header of a negative size": (
        "a.tar", lambda: _end(_header("p", tarfile.XHDTYPE, -512), _file("a.urdf")), "extended header"
    ),
    "a chain of PAX headers": (
        "a.tgz", lambda: _tgz(_pax(_record("comment", "x" * 400)) * 40_000, _file("a.urdf")), "headers"
    ),
    "a chain of GNU names": (
        "a.tgz", lambda: _tgz(_pax(b"a.urdf\0", tarfile.GNUTYPE_LONGNAME) * 40_000, _file("a.urdf")), "headers"
    ),
    "a PAX header of digits": ("a.tgz", lambda: _tgz(_pax(b"1" * (_MEBIBYTE - 1)), _file("a.urdf")), "no length"),
    "PAX records of no length": ("a.tgz", lambda: _tgz(_pax(b"1 " * 2**18 + b"="), _file("a.urdf")), "no length"),
    "a PAX record that ends nowhere": ("a.tgz", lambda: _tgz(_pax(b"999 path=a\n"), _file("a.urdf")), "no length"),
    "a size of 5,000 digits": ("a.tgz", lambda: _tgz(_pax(_record("size", "9" * 5000)), _file("a.urdf")), "size"),
    "an infinite size": ("a.tgz", lambda: _tgz(_pax(_record("size", "inf")), _file("a.urdf")), "has the size inf"),
    "40,000 empty files": ("a.tgz", lambda: _tgz(_numbered(40_000)), "files and folders"),
    "40,000 links": ("a.tgz", lambda: _tgz(_numbered(40_000, tarfile.SYMTYPE)), "headers"),
    "40,000 devices": ("a.tgz", lambda: _tgz(_numbered(40_000, tarfile.CHRTYPE)), "headers"),
    "folders in folders": (
        "a.tgz", lambda: _tgz(*(_file(f"{number}/" + "a/" * 40 + "a.urdf", b"") for number in range(200))),
        "files and folders",
    ),
    "a name of 500 folders": ("a.tgz", lambda: _tgz(_pax(_record("path", "a/" * 500)), _file("a.urdf")), "64 folders"),
    "a name of 40,000 letters": (
        "a.tgz", lambda: _tgz(_pax(_record("path", "a" * 40_000)), _file("a.urdf")), "1024 letters"
    ),
    "a file of 8 EiB": ("a.tar", lambda: _end(_header("a.urdf", size=2**63 - 1), _GOOD), "bytes; unpack"),
    "a file of 9 MiB in 2 KiB": ("a.tar", lambda: _end(_header("a.urdf", size=9 * 2**20), _GOOD), "ends in the middle"),
    "a file of a negative size": ("a.tar", lambda: _end(_header("a.urdf", size=-1), _GOOD), "size"),
    "an odd kind of 4 EiB": ("a.tar", lambda: _end(_header("a.urdf", b"?", 2**62), _GOOD), "bytes; unpack"),
    "a sparse file of GNU": ("a.tar", lambda: _end(_header("a.urdf", tarfile.GNUTYPE_SPARSE)), "--sparse"),
    "a sparse file of PAX": (
        "a.tar", lambda: _end(_pax(_record("GNU.sparse.realsize", "9" * 18)), _file("a.urdf")), "--sparse"
    ),
    "noise between two files": ("a.tar", lambda: _end(_file("a.urdf"), b"?" * 512, _file("b.urdf")), "no header"),
    "a file where a folder is": ("a.tar", lambda: _end(_file("a/b.urdf"), _file("a")), "a folder as well"),
    "a folder where a file is": ("a.zip", lambda: zipped([("a", b""), ("a/b.urdf", b"")]), "a folder as well"),
    "a zero in a name": ("a.tar", lambda: _end(_pax(_record("path", "a\0b.urdf")), _file("a.urdf")), "none everywhere"),
    "zeros in gzip": ("a.tgz", lambda: gzip.compress(_header("a.urdf", size=2**30)) + _zeros(16), "bytes; unpack"),
    "zeros in bzip2": (
        "a.tar.bz2", lambda: bz2.compress(_header("a.urdf", size=2**30)) + bz2.compress(bytes(2**20)),
        "bytes; unpack",
    ),
    "zeros in xz": (
        "a.tar.xz", lambda: lzma.compress(_header("a.urdf", size=2**30)) + lzma.compress(bytes(2**20)),
        "bytes; unpack",
    ),
    "a dictionary of 1.5 GiB in xz": ("a.tar.xz", _xz_with_dictionary, "emory"),
    "half a file in xz": ("a.tar.xz", lambda: lzma.compress(_end(_file("a.urdf")))[:-60], "cannot be unpacked"),
    "one content for 5,000 files in zip": ("a.zip", lambda: _overlapping(5_000, 2**20), "a.zip"),
    "a list of 100,000 files in zip": ("a.zip", lambda: _overlapping(100_000, 1), "list of files"),
    "a list of 20,000 files in zip": ("a.zip", lambda: _overlapping(20_000, 1), "a.zip"),
    "LZMA in zip": ("a.zip", lambda: zipped([("a.urdf", _GOOD)], zipfile.ZIP_LZMA), "compressed in a way"),
    "a method that nobody has in zip": (
        "a.zip", lambda: _patched(zipped([("a.urdf", _GOOD)]), b"PK\x01\x02", 10, b"\x63\0"), "compressed in a way"
    ),
    "an encrypted file in zip": (
        "a.zip", lambda: _patched(zipped([("a.urdf", _GOOD)]), b"PK\x01\x02", 8, b"\x01\0"), "cannot be unpacked"
    ),
    "a list of 4 GiB in zip": (
        "a.zip", lambda: _patched(zipped([("a.urdf", _GOOD)]), b"PK\x05\x06", 12, b"\xfe\xff\xff\xff"), "a.zip"
    ),
    "a list that begins nowhere in zip": (
        "a.zip", lambda: _patched(zipped([("a.urdf", _GOOD)]), b"PK\x05\x06", 16, b"\xfe\xff\xff\x7f"), "a.zip"
    ),
    **{
        f"the name {what} in tar": ("a.tar", lambda name=name: _end(_file(name)), "leads out")
        for what, name in _ODD_NAMES.items()
    },
    **{
        f"the name {what} in zip": ("a.zip", lambda name=name: zipped([(name, _GOOD)]), "leads out")
        for what, name in _ODD_NAMES.items()
    },
}  # fmt: skip
"""By what is wrong: the name of the file, what makes its bytes, and a word of the message."""

LEFT_OUT: Mapping[str, tuple[str, Callable[[], bytes]]] = {
    "links that lead out": (
        "a.tar",
        lambda: _end(
            _header("soft.urdf", tarfile.SYMTYPE, link="/etc/passwd"), _header("hard.urdf", tarfile.LNKTYPE, link="/x"),
            _header("d", tarfile.SYMTYPE, link="/tmp"), _header("pipe.urdf", tarfile.FIFOTYPE), _file("good.urdf"),
        ),
    ),
    "a link that says it has 8 EiB": (
        "a.tar", lambda: _end(_header("soft.urdf", tarfile.SYMTYPE, size=2**60), _file("good.urdf"))
    ),
    "a global header, which names nothing": (
        "a.tar", lambda: _end(_pax(_record("path", "../up.urdf"), tarfile.XGLTYPE), _file("good.urdf"))
    ),
    "a time at the end of all days": ("a.tar", lambda: _end(_pax(_record("mtime", "inf")), _file("good.urdf"))),
    "a time that is no time": ("a.tar", lambda: _end(_pax(_record("mtime", "nan")), _file("good.urdf"))),
    "20,000 empty streams of gzip": ("a.tgz", lambda: gzip.compress(b"") * 20_000 + _tgz(_file("good.urdf"))),
    "an archive in an archive": ("a.zip", lambda: zipped([("in.zip", zipped([("x", b"")])), ("good.urdf", _GOOD)])),
}  # fmt: skip
"""What does no harm: the file `good.urdf` in it is read, and nothing else."""


def placed(folder: Path, name: str, content: bytes) -> Path:
    """An archive with a name in a folder."""
    path = folder / name
    path.write_bytes(content)
    return path
