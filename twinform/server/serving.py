"""A session of the language server on two streams, which ends when its editor says so, or goes away."""

import asyncio
import gc
import logging
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from threading import Thread
from typing import BinaryIO

from twinform.server.framing import read_messages
from twinform.server.settings import SettingsOf, no_settings
from twinform.server.wiring import Server, make_server

# The garbage collector looks rarely: a walk over all trees and imported modules takes longer than a
# key may.
_SELDOM = (100_000, 50, 100)


class _Writer:
    """Writes messages to an editor; once that is not possible, the session has ended."""

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
        """Do nothing: whoever has opened the stream closes it."""


def serve(settings_of: SettingsOf = no_settings) -> int:
    """Talk to an editor on standard input and output until it goes away; gives the exit code that it expects."""
    for name in ("pygls", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    gc.set_threshold(*_SELDOM)
    # a reader of its own: Python's may not be in use when the process ends
    source = os.fdopen(sys.stdin.fileno(), "rb", closefd=False)
    return talk(make_server(settings_of), source, sys.stdout.buffer)


def talk(server: Server, source: BinaryIO, target: BinaryIO) -> int:
    """Answer the messages of an editor until it goes away; gives the exit code that it expects."""
    return asyncio.run(_talk(server, source, target))


async def _talk(server: Server, source: BinaryIO, target: BinaryIO) -> int:
    loop, ended = asyncio.get_running_loop(), asyncio.Event()
    server.protocol.set_writer(_Writer(target, ended.set))
    server.on_parent = lambda parent: _watch(loop, parent, ended.set)
    # a thread that Python does not wait for: nothing ends a read from a stream that stays open
    Thread(target=_read, args=(server, source, loop, ended), daemon=True).start()
    try:
        await ended.wait()
    finally:
        server.session.stop()
    return 1 if server.protocol.exit_code is None else server.protocol.exit_code


def _read(server: Server, source: BinaryIO, loop: asyncio.AbstractEventLoop, ended: asyncio.Event) -> None:
    """Hand over the messages of a stream one by one, so that no more than one waits."""

    async def take(message: bytes | None) -> None:
        server.protocol.receive(message)

    # the session may end in the meantime, and with it the loop
    with suppress(RuntimeError, OSError):
        for message in read_messages(source):
            asyncio.run_coroutine_threadsafe(take(message), loop).result()
            if server.protocol.exit_code is not None:
                break
        loop.call_soon_threadsafe(ended.set)


def _watch(loop: asyncio.AbstractEventLoop, parent: int, end: Callable[[], None]) -> None:
    """End when a process does; that of an editor outside of this container cannot be watched."""
    with suppress(AttributeError, OSError, OverflowError):  # only Linux has it
        loop.add_reader(os.pidfd_open(parent), end)
