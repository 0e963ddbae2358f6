"""Messages in a stream of bytes: each is JSON behind a header that tells its length.

Whatever is in the stream, no more of it is kept than one message, and reading goes on behind what is no message: at the
next header, which cannot be within JSON, where no string has a line end.
"""

import re
from collections.abc import Iterator
from typing import BinaryIO

# pygls reads headers of any length and reserves whatever they promise.
LARGEST_MESSAGE = 256 * 2**20
"""The longest message in bytes: a text of 40 MiB, in which each character is escaped, fits."""
_LONGEST_LINE = 1024
_PIECE = 2**20
# found at the end of a line, since what is left of a message that was longer than its header said may stand before it
_LENGTH = re.compile(rb"content-length:[ \t]*(?P<length>\d{1,12})[ \t]*\r?\n", re.IGNORECASE)


def read_messages(stream: BinaryIO) -> Iterator[bytes | None]:
    """The messages of a stream up to its end, without their headers; None for each piece that is no message."""
    length: int | None = None
    is_lost = False
    while line := stream.readline(_LONGEST_LINE):
        found = _LENGTH.search(line)
        if found is not None:
            length = int(found["length"])
        elif line in {b"\r\n", b"\n"} and length is not None and 0 < length <= LARGEST_MESSAGE:
            body = _read_body(stream, length)
            if body is None:
                return
            yield body
            length, is_lost = None, False
        elif not _is_header(line) and not is_lost:
            yield None
            length, is_lost = None, True


def _is_header(line: bytes) -> bool:
    """Whether a line is one of a header, such as that of the content's type."""
    return line[:1].isalpha() and b":" in line and line.endswith(b"\n")


def _read_body(stream: BinaryIO, length: int) -> bytes | None:
    """The next bytes; None where the stream ends before."""
    # in pieces: Python reserves at once whatever it is asked for
    body = bytearray()
    while len(body) < length:
        piece = stream.read(min(length - len(body), _PIECE))
        if not piece:
            return None
        body += piece
    return bytes(body)
