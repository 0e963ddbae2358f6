"""A session of the language server on two streams, and the messages in them.

A message is JSON behind a header with its length. No more than one message is kept in memory, and after bytes that are
no message, reading goes on at the next header; none can be within JSON, whose strings have no line ends.
"""

import asyncio
import gc
import logging
import os
import re
import sys
from collections.abc import Callable, Iterator
from contextlib import suppress
from threading import Thread
from typing import BinaryIO

from twinform.lazy import lazy_pattern
from twinform.server.checking import SettingsOf, no_settings
from twinform.server.wiring import Server, make_server

# The garbage collector runs rarely: a walk over all trees and imported modules takes longer than a key may.
_SELDOM = (100_000, 50, 100)


class _Writer:
    """Writes messages to an editor, and ends the session when that fails."""

    def __init__(self, stream: BinaryIO, end: Callable[[], None]) -> None:
        self._stream, self._end = stream, end

    def write(self, data: bytes) -> None:
        """Write one message."""
        try:
            self._stream.write(data)
            self._stream.flush()
        except (OSError, ValueError):  # nobody reads any more, or the stream is closed
            self._end()

    def close(self) -> None:
        """Do nothing, since whoever opened the stream closes it."""


def serve(settings_of: SettingsOf = no_settings) -> int:
    """Serve an editor on standard input and output until it goes away; return the exit code that it expects."""
    for name in ("pygls", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    gc.set_threshold(*_SELDOM)
    # a reader of our own, since Python's must not be in use when the process ends
    source = os.fdopen(sys.stdin.fileno(), "rb", closefd=False)
    return talk(make_server(settings_of), source, sys.stdout.buffer)


def talk(server: Server, source: BinaryIO, target: BinaryIO) -> int:
    """Answer the messages of an editor until it goes away; return the exit code that it expects."""
    return asyncio.run(_talk(server, source, target))


async def _talk(server: Server, source: BinaryIO, target: BinaryIO) -> int:
    loop, ended = asyncio.get_running_loop(), asyncio.Event()
    server.protocol.set_writer(_Writer(target, ended.set))
    server.on_parent = lambda parent: _watch(loop, parent, ended.set)
    # a daemon, for nothing ends a read from a stream that stays open
    Thread(target=_read, args=(server, source, loop, ended), daemon=True).start()
    try:
        await ended.wait()
    finally:
        server.session.stop()
    return 1 if server.protocol.exit_code is None else server.protocol.exit_code


def _read(server: Server, source: BinaryIO, loop: asyncio.AbstractEventLoop, ended: asyncio.Event) -> None:
    """Pass the messages of a stream to the server one by one."""

    async def take(message: bytes | None) -> None:
        server.protocol.receive(message)

    # the session may end meanwhile, and the loop with it
    with suppress(RuntimeError, OSError):
        for message in read_messages(source):
            asyncio.run_coroutine_threadsafe(take(message), loop).result()
            if server.protocol.exit_code is not None:
                break
        loop.call_soon_threadsafe(ended.set)


def _watch(loop: asyncio.AbstractEventLoop, parent: int, end: Callable[[], None]) -> None:
    """Call `end` when a process ends; one outside of this container cannot be watched."""
    with suppress(AttributeError, OSError, OverflowError):  # only Linux has it
        loop.add_reader(os.pidfd_open(parent), end)


# pygls reads headers of any length and reserves whatever they promise.
LARGEST_MESSAGE = 256 * 2**20
"""The longest message in bytes: a text of 40 MiB, in which each character is escaped, fits."""
_LONGEST_LINE = 1024
_PIECE = 2**20
# Searched at the end of a line: the rest of a message longer than its header said may stand before it.
_LENGTH = lazy_pattern(rb"content-length:[ \t]*(?P<length>\d{1,12})[ \t]*\r?\n", re.IGNORECASE)


def read_messages(stream: BinaryIO) -> Iterator[bytes | None]:
    """Yield the messages of a stream without their headers; None for each piece that is no message."""
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
    """Whether a line is part of a header, such as `Content-Type: ...`."""
    return line[:1].isalpha() and b":" in line and line.endswith(b"\n")


def _read_body(stream: BinaryIO, length: int) -> bytes | None:
    """Read a number of bytes; None if the stream ends before."""
    # in pieces, since Python reserves the memory for a whole read at once
    body = bytearray()
    while len(body) < length:
        piece = stream.read(min(length - len(body), _PIECE))
        if not piece:
            return None
        body += piece
    return bytes(body)
