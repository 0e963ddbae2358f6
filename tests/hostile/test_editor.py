"""The language server as an editor starts it: hostile streams, processes that are killed, editors that go away."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, cast

import pytest

from tests.unit.server.playing import INITIALIZE, notification, opened, request

TWICE = '<robot name="r"><link name="a"/><link name="a"/></robot>'
JUNK = (
    b"Content-Length: -5\r\n\r\n",
    b"Content-Length: 1000000000000\r\n\r\n{}",
    b"Content-Length: " + b"9" * 5_000 + b"\r\n\r\n{}",
    b"\r\n\r\n",
    b"X: " + b"a" * 4_000_000 + b"\n",
)
_SECONDS = 60
Message = dict[str, Any]


class Session:
    """The command with its streams."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        self.process = process
        self.source, self.target = cast("IO[bytes]", process.stdout), cast("IO[bytes]", process.stdin)

    def send(self, *bodies: bytes) -> None:
        for body in bodies:
            self.target.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))
        self.target.flush()

    def messages(self) -> Iterator[Message]:
        while line := self.source.readline():
            if line.startswith(b"Content-Length: "):
                length = int(line.removeprefix(b"Content-Length: "))
                while self.source.readline().strip():
                    pass
                yield json.loads(self.source.read(length))

    def begin(self, parent: int | None = None) -> None:
        self.send(request(0, "initialize", INITIALIZE | {"processId": parent}), notification("initialized", {}))

    def rules(self, path: Path, text: str = TWICE) -> list[str]:
        """The rules of the findings in a document that is opened."""
        self.send(opened(path.as_uri(), text))
        for each in self.messages():
            if each.get("method") == "textDocument/publishDiagnostics" and each["params"]["uri"] == path.as_uri():
                return [found.get("code", found["message"]) for found in each["params"]["diagnostics"]]
        raise AssertionError("the server has ended")


@contextmanager
def started(folder: Path) -> Generator[Session]:
    command = [sys.executable, "-m", "twinform", "lsp"]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, cwd=folder, stdin=pipe, stdout=pipe, stderr=pipe) as process:
        yield Session(process)
        process.kill()


def ended(session: Session) -> tuple[int, bytes]:
    """The exit code, and what was written on standard error, once the session and all its processes have ended."""
    code = session.process.wait(_SECONDS)
    # whoever is left holds it open
    return code, cast("IO[bytes]", session.process.stderr).read()


def children(pid: int) -> list[int]:
    return [int(each) for each in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def test_a_hostile_stream_costs_nothing_but_its_own_messages(tmp_path: Path) -> None:
    with started(tmp_path) as session:
        session.begin()
        for data in JUNK:
            session.target.write(data)
            session.send(request("next", "workspace/symbol", {"query": ""}))
            answers = (each for each in session.messages() if "method" not in each and each["id"] != 0)
            assert [next(answers).get("error", {}).get("code") for _ in range(2)] == [-32700, None]
        session.send(opened("file:///nowhere/a%00b.urdf", TWICE))
        session.send(*(request(n, "textDocument/hover", {}) for n in range(1, 100)))
        assert session.rules(tmp_path / "robot.urdf") == ["duplicate-name"]
        peak = Path(f"/proc/{session.process.pid}/status").read_text().partition("VmHWM:")[2].split()[0]
        assert int(peak) < 500_000
        session.send(notification("exit", None))
        assert ended(session) == (1, b"")


def test_a_worker_that_was_killed_is_replaced(tmp_path: Path) -> None:
    with started(tmp_path) as session:
        session.begin()
        for number in range(3):
            assert session.rules(tmp_path / f"{number}.urdf") == ["duplicate-name"]
            for child in children(session.process.pid):
                os.kill(child, signal.SIGKILL)
        assert session.rules(tmp_path / "last.urdf") == ["duplicate-name"]
        session.send(request(1, "shutdown", None), notification("exit", None))
        assert ended(session)[0] == 0


@pytest.mark.parametrize(
    ("number", "code"),
    [
        (signal.SIGTERM, 143),
        pytest.param(signal.SIGKILL, -signal.SIGKILL, marks=pytest.mark.deep),
    ],
)
def test_a_server_that_is_ended_leaves_no_process_and_no_traceback(tmp_path: Path, number: int, code: int) -> None:
    with started(tmp_path) as session:
        session.begin()
        assert session.rules(tmp_path / "robot.urdf") == ["duplicate-name"]
        workers = children(session.process.pid)
        session.process.send_signal(number)
        found, errors = ended(session)
        assert (found, b"Traceback" in errors) == (code, False)
        assert not any(is_running(each) for each in workers)


def test_a_server_whose_editor_is_gone_ends(tmp_path: Path) -> None:
    with started(tmp_path) as session, subprocess.Popen(["sleep", "1000"]) as editor:
        session.begin(editor.pid)
        assert session.rules(tmp_path / "robot.urdf") == ["duplicate-name"]
        workers = children(session.process.pid)
        editor.kill()  # the streams stay open
        assert ended(session) == (1, b"")
        assert not any(is_running(each) for each in workers)


def test_a_server_whose_input_is_closed_ends(tmp_path: Path) -> None:
    with started(tmp_path) as session:
        session.begin()
        session.target.close()
        assert ended(session) == (1, b"")


def is_running(pid: int) -> bool:
    """Whether a process runs still, or does so within a few seconds that it may take to end."""
    for _ in range(100):
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return False
        time.sleep(0.1)
    return True
