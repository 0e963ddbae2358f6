"""Replaces pieces of bytes, and leaves all around them as it is."""

import os
from collections.abc import Iterable
from typing import NamedTuple


class NamedSpan(NamedTuple):
    """A name as it is meant, and where it is written."""

    name: str
    start: int
    end: int


def names(spans: Iterable[NamedSpan]) -> list[str]:
    """Each name once, in the order of the file."""
    return list(dict.fromkeys(span.name for span in spans))


def replaced(data: bytes, pieces: Iterable[tuple[NamedSpan, bytes]]) -> bytes:
    """The bytes with other pieces in the place of spans, which are in order and do not overlap."""
    parts: list[bytes] = []
    end = 0
    for span, piece in pieces:
        parts += (data[end : span.start], piece)
        end = span.end
    return b"".join((*parts, data[end:]))


def text(written: bytes) -> str:
    """A name; bytes that are no UTF-8 stay what they are, in its encoding as a file name."""
    return os.fsdecode(written)


def encoded(name: str) -> bytes:
    """The bytes of a name."""
    return os.fsencode(name)
