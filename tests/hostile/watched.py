"""The command, run as a script with every file that it opens noted on the last line of standard error.

As `watched.py --serve FD` it stays: the program is in memory already, and for each order that comes through the socket
a fork of it runs the command. Starting Python and importing the compiler takes ten times as long as most commands.
"""

import json
import os
import resource
import signal
import socket
import sys
from collections.abc import Sequence

_LONGEST_ORDER = 65536
_STREAMS = (1, 2)


def limit(memory: int, seconds: int) -> None:
    """Hold this process to so many bytes of memory and seconds of the processor, and to no file written."""
    resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))


def _run(words: Sequence[str]) -> None:
    seen: set[str] = set()

    def hook(event: str, arguments: tuple[object, ...]) -> None:
        path = arguments[0] if event == "open" else None
        if isinstance(path, str | bytes | os.PathLike):
            seen.add(os.path.realpath(os.fsdecode(path)))

    sys.addaudithook(hook)
    from twinform.cli import main  # noqa: PLC0415 - what it opens is looked at

    try:
        main(words)
    finally:
        print(json.dumps(sorted(seen)), file=sys.stderr)  # noqa: T201 - it is for the process that waits


def _ordered(connection: socket.socket) -> list[str]:
    """The words of a command, in a new process for each that is ordered."""
    while True:
        order, streams, _, _ = socket.recv_fds(connection, _LONGEST_ORDER, len(_STREAMS))
        if not order:
            os._exit(0)
        child = os.fork()
        if not child:
            connection.close()
            return _begun(json.loads(order), streams)
        for stream in streams:
            os.close(stream)
        _, status = os.waitpid(child, 0)
        connection.send(json.dumps(os.waitstatus_to_exitcode(status)).encode())


def _begun(order: dict[str, object], streams: Sequence[int]) -> list[str]:
    match order:
        case {"words": list(words), "folder": str(folder), "memory": int(memory), "seconds": int(seconds)}:
            for stream, number in zip(streams, _STREAMS, strict=True):
                os.dup2(stream, number)
                os.close(stream)
            os.chdir(folder)
            limit(memory, seconds)
            return [str(word) for word in words]
        case _:
            raise ValueError(f"no order: {order}")


def _imported() -> None:
    """Import all that the commands import when they are used."""
    from twinform.cli import check, convert  # noqa: F401, PLC0415 - a single command starts without
    from twinform.compiler import checking, driver  # noqa: F401, PLC0415 - likewise


if __name__ == "__main__":
    match sys.argv[1:]:
        case ["--serve", number]:
            signal.signal(signal.SIGINT, signal.SIG_IGN)  # the tests end it by closing the socket
            _imported()
            _run(_ordered(socket.socket(fileno=int(number))))
        case words:
            _run(words)
