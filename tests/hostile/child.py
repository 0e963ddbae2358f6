"""The command in a process that is watched: little time and memory, nothing to write, and every file it opens noted.

`make prove` starts Python for each command; the quick tests fork a process that has imported the program.
"""

import atexit
import json
import os
import socket
import subprocess
import sys
import sysconfig
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path

from tests.hostile.watched import ChildRequest, limit
from tests.profile import DEEP

MEMORY = 512 * 2**20
SECONDS = 2 if DEEP else 4
"""Of processor time. `make prove` holds what is promised; the quick tests must not fail where a machine is slow."""
_OWN = (sys.prefix, sys.base_prefix, sysconfig.get_path("stdlib"), str(Path(__file__).parents[2] / "twinform"), "/proc")
_FEW_THREADS = {"MALLOC_ARENA_MAX": "2", "OPENBLAS_NUM_THREADS": "1"}
"""Each thread of malloc and of OpenBLAS reserves 64 MB of addresses that it does not use; the limit counts them."""
_WATCHED = Path(__file__).with_name("watched.py")


@dataclass(frozen=True, slots=True)
class Outcome:
    """What the command printed, how it ended, and the files that it opened besides the program's own."""

    code: int
    output: str
    opened: frozenset[str]


def twinform(
    *arguments: str | Path,
    folder: Path,
    seconds: int = SECONDS,
    environment: Mapping[str, str] | None = None,
    written: int = 0,
) -> Outcome:
    """Run the command where it may write nothing at all, or files of so many bytes."""
    run = _started if DEEP else _forked
    words = [str(word) for word in arguments]
    request = ChildRequest(
        arguments=words,
        folder=str(folder),
        memory=MEMORY,
        seconds=seconds,
        environment=dict(environment or {}),
        written=written,
    )
    code, output, errors = run(request)
    *lines, last = errors.decode(errors="replace").splitlines() or [""]
    opened: list[str] = json.loads(last) if last.startswith("[") else []
    text = output.decode(errors="replace") + "\n".join([*lines, "" if last.startswith("[") else last])
    return Outcome(code, text, frozenset(each for each in opened if not _is_own(each)))


def _started(request: ChildRequest) -> tuple[int, bytes, bytes]:
    """Its exit code and what it printed on both streams, in a process that knows nothing, as a user starts it."""
    done = subprocess.run(
        [sys.executable, "-B", _WATCHED, *request["arguments"]],
        cwd=request["folder"],
        capture_output=True,
        preexec_fn=partial(limit, MEMORY, request["seconds"], request["written"]),
        env={**_environment(), **request["environment"]},
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


def _forked(request: ChildRequest) -> tuple[int, bytes, bytes]:
    """The same in a fork of a process that has imported the program."""
    connection = _server()
    ours, theirs = zip(os.pipe(), os.pipe(), strict=True)
    socket.send_fds(connection, [json.dumps(request).encode()], theirs)
    for stream in theirs:
        os.close(stream)
    with ThreadPoolExecutor(len(ours)) as readers:
        output, errors = readers.map(_rest, ours)
    return json.loads(connection.recv(100)), output, errors


def _rest(stream: int) -> bytes:
    with os.fdopen(stream, "rb") as file:
        return file.read()


@cache
def _server() -> socket.socket:
    """The connection to the process that forks; it ends when this one does."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    with theirs:
        number = theirs.fileno()
        nothing = subprocess.DEVNULL
        process = subprocess.Popen(
            [sys.executable, "-B", _WATCHED, "--serve", str(number)],
            pass_fds=[number],
            stdin=nothing,
            stdout=nothing,
            env=_environment(),
        )
    atexit.register(_end, ours, process)
    return ours


def _end(connection: socket.socket, process: subprocess.Popen[bytes]) -> None:
    connection.close()
    process.wait()


def _environment() -> dict[str, str]:
    # a process that may not write cannot be measured either
    kept = {name: value for name, value in os.environ.items() if not name.startswith("COV")}
    return {**kept, **_FEW_THREADS}


def _is_own(path: str) -> bool:
    return path == os.devnull or any(path.startswith(os.path.realpath(each)) for each in _OWN)


def rules(output: str, severity: str = "error") -> Sequence[str]:
    """The rules of the findings of a severity, in the order in which they were printed."""
    lines = [line for line in output.splitlines() if f": {severity}: " in line and line.endswith("]")]
    return [line.rpartition("[")[2].rstrip("]") for line in lines]
