"""The command, run as a script with every file that it opens noted on the last line of standard error.

As `watched.py --serve FD` it stays: the program is in memory already, and for each request through the socket
a fork of it runs the command. Starting Python and importing the compiler takes ten times as long as most commands.
"""

import json
import os
import resource
import signal
import socket
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import TypedDict, cast

_LONGEST_REQUEST = 65536
_STREAMS = (1, 2)
_STUCK = 120
"""Seconds of the clock after which a process ends that waits for a pipe, which takes no time of the processor."""
_USED = ("cli.check", "cli.convert", "compiler.inspection", "compiler.conversion")
"""What commands import when they are used."""


class ChildRequest(TypedDict):
    """A command, where it runs, and what it may take."""

    arguments: list[str]
    folder: str
    memory: int
    seconds: int
    environment: dict[str, str]
    written: int


def limit(memory: int, seconds: int, written: int = 0) -> None:
    """Hold this process to so many bytes of memory, seconds of the processor, and bytes of a file that it writes."""
    signal.alarm(_STUCK)
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    resource.setrlimit(resource.RLIMIT_FSIZE, (written, written))


def _run(arguments: Sequence[str]) -> None:
    seen: set[str] = set()

    def hook(event: str, arguments: tuple[object, ...]) -> None:
        if event == "open" and not isinstance(arguments[0], int):
            path = cast("str | bytes | os.PathLike[str]", arguments[0])
            seen.add(os.path.realpath(os.fsdecode(path)))

    sys.addaudithook(hook)
    from twinform.cli import main  # noqa: PLC0415 - what it opens is looked at

    try:
        main(arguments)
    finally:
        print(json.dumps(sorted(seen)), file=sys.stderr)  # noqa: T201 - it is for the process that waits


def _requested(connection: socket.socket) -> list[str]:
    """The arguments of a command, in a new process for each request."""
    while True:
        request, streams, _, _ = socket.recv_fds(connection, _LONGEST_REQUEST, len(_STREAMS))
        if not request:
            os._exit(0)
        child = os.fork()
        if not child:
            connection.close()
            return _begun(json.loads(request), streams)
        for stream in streams:
            os.close(stream)
        _, status = os.waitpid(child, 0)
        connection.send(json.dumps(os.waitstatus_to_exitcode(status)).encode())


def _begun(request: ChildRequest, streams: Sequence[int]) -> list[str]:
    for stream, number in zip(streams, _STREAMS, strict=True):
        os.dup2(stream, number)
        os.close(stream)
    os.chdir(request["folder"])
    os.environ.update(request["environment"])
    limit(request["memory"], request["seconds"], request["written"])
    return request["arguments"]


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["--serve", number]:
            signal.signal(signal.SIGINT, signal.SIG_IGN)  # the tests end it by closing the socket
            for module in _USED:
                import_module(f"twinform.{module}")
            _run(_requested(socket.socket(fileno=int(number))))
        case arguments:
            _run(arguments)
