"""The language server as an editor starts it: hostile streams, processes that are killed, editors that go away."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Generator, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any, cast

import pytest

from testbed.editor.playing import INITIALIZE, notification, opened, request
from tests.profile import DEEP

TWICE = '<robot name="r"><link name="a"/><link name="a"/></robot>'
JUNK = (
    b"Content-Length: -5\r\n\r\n",
    b"Content-Length: 1000000000000\r\n\r\n{}",
    b"Content-Length: " + b"9" * 5_000 + b"\r\n\r\n{}",
    b"\r\n\r\n",
    b"X: " + b"a" * 4_000_000 + b"\n",
)
_SECONDS = 60
_MEMORY = 500_000
_CANCELLED = -32800
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

    def begin(self, parent: int | None = None, folder: Path | None = None) -> None:
        folders = [{"uri": folder.as_uri(), "name": "workspace"}] if folder else None
        params = INITIALIZE | {"processId": parent, "workspaceFolders": folders}
        self.send(request(0, "initialize", params), notification("initialized", {}))

    def until(self, id_: object) -> list[Message]:
        """What the server says until the answer to a request, which comes last."""
        said: list[Message] = []
        for each in self.messages():
            said.append(each)
            if "method" not in each and each["id"] == id_:
                return said
        raise AssertionError("the server has ended")

    def ask(self, method: str, params: Message) -> Message:
        """The answer to a request."""
        self.send(request(method, method, params))
        return self.until(method)[-1]

    def rules(self, path: Path, text: str = TWICE) -> list[str]:
        """The rules of the findings in a document that is opened."""
        self.send(opened(path.as_uri(), text))
        for each in self.messages():
            if each.get("method") == "textDocument/publishDiagnostics" and each["params"]["uri"] == path.as_uri():
                return [found.get("code", found["message"]) for found in each["params"]["diagnostics"]]
        raise AssertionError("the server has ended")


@contextmanager
def started(folder: Path, environment: Mapping[str, str] | None = None) -> Generator[Session]:
    command = [sys.executable, "-m", "twinform", "lsp"]
    pipe = subprocess.PIPE
    env = {**os.environ, **(environment or {})}
    with subprocess.Popen(command, cwd=folder, stdin=pipe, stdout=pipe, stderr=pipe, env=env) as process:
        yield Session(process)
        process.kill()


def ended(session: Session) -> tuple[int, bytes]:
    """The exit code, and what was written on standard error, once the session and all its processes have ended."""
    code = session.process.wait(_SECONDS)
    # whoever is left holds it open
    return code, cast("IO[bytes]", session.process.stderr).read()


def children(pid: int) -> list[int]:
    return [int(each) for each in Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Session, Path]]:
    """A server for the tests that do not end it, and its workspace, which is a folder of a repository."""
    repository = tmp_path_factory.mktemp("repository")
    folder = repository / "workspace"
    (repository / ".git").mkdir()
    folder.mkdir()
    with started(folder) as session:
        session.begin(folder=folder)
        yield session, folder
        session.send(notification("exit", None))
        assert ended(session) == (1, b"")


def peak(session: Session) -> int:
    """The most memory that the server has had, in kilobytes."""
    return int(Path(f"/proc/{session.process.pid}/status").read_text().partition("VmHWM:")[2].split()[0])


def test_a_hostile_stream_costs_nothing_but_its_own_messages(shared: tuple[Session, Path]) -> None:
    session, folder = shared
    for data in JUNK:
        session.target.write(data)
        session.send(request("next", "workspace/symbol", {"query": ""}))
        answers = (each for each in session.messages() if "method" not in each and each["id"] != 0)
        assert [next(answers).get("error", {}).get("code") for _ in range(2)] == [-32700, None]
    session.send(opened("file:///nowhere/a%00b.urdf", TWICE))
    session.send(*(request(n, "textDocument/hover", {}) for n in range(1, 100)))
    assert session.rules(folder / "robot.urdf") == ["duplicate-name"]
    assert peak(session) < _MEMORY


def test_a_flood_of_edits_and_a_huge_text_leave_the_server_alive_and_small(shared: tuple[Session, Path]) -> None:
    session, folder = shared
    uri = (folder / "flood.urdf").as_uri()
    session.rules(folder / "flood.urdf")
    edits = 10_000 if DEEP else 300
    huge = "<a>" * (2**26 // 3) if DEEP else "<a>" * 2**21
    for number in range(edits):
        document = {"uri": uri, "version": number + 2}
        text = huge if number == edits // 2 else TWICE.replace('"r"', f'"r{number}"')
        session.send(
            notification("textDocument/didChange", {"textDocument": document, "contentChanges": [{"text": text}]}),
            request(number, "textDocument/formatting", {"textDocument": {"uri": uri}, "options": {}}),
            notification("$/cancelRequest", {"id": number}),
        )
        session.until(number)
    answer = session.ask("textDocument/documentSymbol", {"textDocument": {"uri": uri}})
    assert answer["result"][0]["name"] == f"r{edits - 1}"
    assert session.rules(folder / "after.urdf") == ["duplicate-name"]
    assert peak(session) < _MEMORY


_HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'
_USE = _HEAD + '<xacro:include filename="{}"/><xacro:part/></robot>'
_PART = _HEAD + '<xacro:macro name="part"><link name="s3cret"/></xacro:macro></robot>'


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("../parts/part.xacro", "is outside of the workspace"),
        ("link.xacro", "is outside of the workspace"),
        ("folder/part.xacro", "is outside of the workspace"),
        (".hidden/part.xacro", "nothing here is called 'part'"),
        ("../../part.xacro", "nothing here is called 'part'"),
        ("far.xacro", "nothing here is called 'part'"),
    ],
)
def test_a_rename_changes_nothing_outside_of_the_workspace(
    name: str, reason: str, shared: tuple[Session, Path], tmp_path: Path
) -> None:
    session, folder = shared
    parts = folder.parent / "parts"
    for place in (parts, folder / ".hidden", folder.parents[1], tmp_path):
        place.mkdir(exist_ok=True)
        (place / "part.xacro").write_text(_PART)
    for link, target in (
        ("link.xacro", parts / "part.xacro"),
        ("folder", parts),
        ("far.xacro", tmp_path / "part.xacro"),
    ):
        (folder / link).unlink(missing_ok=True)
        (folder / link).symlink_to(target)
    text = _USE.format(name)
    path = folder / "use.xacro"
    session.send(opened(path.as_uri(), text))
    place = {"textDocument": {"uri": path.as_uri()}, "position": {"line": 0, "character": text.index(":part") + 3}}
    answer = session.ask("textDocument/rename", place | {"newName": "b"})
    assert reason in answer["error"]["message"]
    if "nothing" in reason:  # it is not even read
        assert session.ask("textDocument/definition", place)["result"] == []
        assert session.ask("textDocument/documentLink", place)["result"] == []
        assert "s3cret" not in json.dumps(session.ask("textDocument/hover", place))


def _command(pipeline: str, path: Path) -> Message:
    return {"command": "twinform.runPasses", "arguments": [path.as_uri(), pipeline]}


@pytest.mark.parametrize(
    "pipeline",
    [
        "bridge-config{file=made.yaml}",
        "simplify-meshes{triangles=10}",
        "@other",
        "nonsense](command:workbench.action.terminal.new)",
        "[a](command:x){",
    ],
)
def test_passes_that_an_editor_runs_write_nothing_and_their_messages_link_to_nothing(
    pipeline: str, shared: tuple[Session, Path]
) -> None:
    session, folder = shared
    path = folder / "robot.urdf"
    session.send(opened(path.as_uri(), TWICE.replace('"a"', '"b"', 1)))
    before = sorted(folder.rglob("*"))
    session.send(request("command", "workspace/executeCommand", _command(pipeline, path)))
    said = session.until("command")
    (message,) = [each["params"]["message"] for each in said if each.get("method") == "window/showMessage"]
    assert "has changed nothing" in message
    assert "](" not in message
    assert not [each for each in said if each.get("method") == "workspace/applyEdit"]
    assert sorted(folder.rglob("*")) == before


def test_a_command_that_was_cancelled_changes_nothing(shared: tuple[Session, Path]) -> None:
    session, folder = shared
    path = folder / "cancelled.urdf"
    session.rules(path, '<robot name="r"><link name="a"/></robot>')
    session.send(
        request("command", "workspace/executeCommand", _command("rename{names=[a:c]}", path)),
        notification("$/cancelRequest", {"id": "command"}),
    )
    said = session.until("command")
    assert said[-1]["error"]["code"] == _CANCELLED, said
    document = {"textDocument": {"uri": path.as_uri()}, "options": {"tabSize": 2, "insertSpaces": True}}
    session.send(request("after", "textDocument/formatting", document))
    assert not [each for each in session.until("after") if each.get("method") == "workspace/applyEdit"]


def test_a_package_that_a_configuration_names_is_not_imported(tmp_path: Path) -> None:
    packages, folder, sign = tmp_path / "site", tmp_path / "workspace", tmp_path / "imported"
    (packages / "evil-1.dist-info").mkdir(parents=True)
    (packages / "evil-1.dist-info/METADATA").write_text("Metadata-Version: 2.1\nName: evil\nVersion: 1\n")
    (packages / "evil-1.dist-info/entry_points.txt").write_text("[twinform.passes]\nevil = evil:Evil\n")
    (packages / "evil.py").write_text(f"open({str(sign)!r}, 'w')\n")
    folder.mkdir()
    (folder / "twinform.toml").write_text(
        "passes = 'evil'\ncheck-passes = 'evil'\n[pipelines]\np = 'evil'\n[[files]]\nmatch = ['*']\npasses = 'evil'\n"
    )
    with started(folder, {"PYTHONPATH": str(packages)}) as session:
        session.begin(folder=folder)
        assert session.rules(folder / "robot.urdf") == ["duplicate-name"]
        session.send(request("command", "workspace/executeCommand", _command("@p", folder / "robot.urdf")))
        session.until("command")
        assert not sign.exists()


@pytest.mark.deep
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
        (signal.SIGINT, 130),
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
        session.until(0)
        editor.kill()  # the streams stay open
        assert ended(session) == (1, b"")


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
