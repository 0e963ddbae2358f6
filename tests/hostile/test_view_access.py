"""Who may talk to `twinform view`: other web pages, other programs and other names of this machine may not."""

import asyncio
import socket
import subprocess
from collections.abc import Iterator, Mapping
from contextlib import closing
from http.client import HTTPConnection
from importlib.metadata import version
from pathlib import Path
from typing import Any
from urllib.parse import SplitResult, urlsplit

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus
from websockets.typing import Origin, Subprotocol

from tests.write_files import write_files

from .every_command import FILES, PROGRAM

pytest.importorskip("viser", reason="viser is not installed")


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[subprocess.Popen[str]]:
    folder = tmp_path_factory.mktemp("models")
    write_files(folder, FILES)
    pipe = subprocess.PIPE
    command = [PROGRAM, "view", "cube.urdf", "--no-open"]
    with subprocess.Popen(command, cwd=folder, stdout=pipe, stderr=pipe, text=True) as process:
        yield process
        process.terminate()
        assert process.stderr is not None
        assert not process.stderr.read()


@pytest.fixture(scope="module")
def opened(running: subprocess.Popen[str]) -> SplitResult:
    """The address that the command prints."""
    assert running.stdout is not None
    line = running.stdout.readline()
    address: str = next(word for word in line.split() if word.startswith("http"))
    return urlsplit(address.rstrip(";"))


def _get(netloc: str, path: str, headers: Mapping[str, str]) -> tuple[int, bytes]:
    """The status and content of a page."""
    with closing(HTTPConnection(netloc, timeout=60)) as connection:
        connection.request("GET", path, headers=dict(headers))
        response = connection.getresponse()
        content: bytes = response.read()
        return response.status, content


def _socket(netloc: str, path: str, **options: Any) -> bytes | str:
    """The first message that the server sends to a WebSocket."""

    async def first() -> bytes | str:
        protocol = Subprotocol(f"viser-v{version('viser')}")
        async with connect(f"ws://{netloc}{path}", subprotocols=[protocol], proxy=None, **options) as connection:
            message: bytes | str = await asyncio.wait_for(connection.recv(), 60)
            return message

    return asyncio.run(first())


def test_the_opened_address_works(opened: SplitResult) -> None:
    for path in (opened.path, f"{opened.path}/"):
        status, content = _get(opened.netloc, path, {})
        assert status == 200
        assert b"<html" in content.lower()
    assert _socket(opened.netloc, opened.path, origin=Origin(f"http://{opened.netloc}"))


def test_it_listens_on_this_machine_alone(opened: SplitResult) -> None:
    listening = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    places = {row[1] for row in listening if row[3] == "0A" and row[1].endswith(f":{opened.port:04X}")}
    assert places == {f"0100007F:{opened.port:04X}"}
    assert not any(f":{opened.port:04X} " in line for line in Path("/proc/net/tcp6").read_text().splitlines())


_FOREIGN: Mapping[str, tuple[str, Mapping[str, str]]] = {
    "no token": ("/", {}),
    "a wrong token": ("/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA", {}),
    "a token in the query": ("/?TOKEN", {}),
    "a token further down": ("/x/TOKEN", {}),
    "a token and more": ("/TOKENx", {}),
    "half a token": ("/HALF", {}),
    "two slashes": ("//TOKEN", {}),
    "another name of this machine": ("/TOKEN", {"Host": "attacker.example:PORT"}),
    "a name that begins alike": ("/TOKEN", {"Host": "127.0.0.1.attacker.example:PORT"}),
    "an address of the network": ("/TOKEN", {"Host": "192.168.0.7:PORT"}),
    "another page": ("/TOKEN", {"Origin": "https://attacker.example"}),
    "a page of another server here": ("/TOKEN", {"Origin": "http://127.0.0.1:1"}),
    "a page without an origin": ("/TOKEN", {"Origin": "null"}),
    "a path that leads out": ("/../TOKEN", {}),
}


@pytest.mark.parametrize("case", _FOREIGN)
def test_anything_else_is_refused(opened: SplitResult, case: str) -> None:
    path, headers = _FOREIGN[case]
    token = opened.path.removeprefix("/")
    path = path.replace("TOKEN", token).replace("HALF", token[:16])
    headers = {name: value.replace("PORT", str(opened.port)) for name, value in headers.items()}
    assert _get(opened.netloc, path, headers)[0] == 403
    if "Host" not in headers:  # the client writes one of its own
        with pytest.raises(InvalidStatus, match="403"):
            _socket(opened.netloc, path, origin=headers.get("Origin"))


def test_a_socket_for_another_name_is_refused(opened: SplitResult) -> None:
    with pytest.raises(InvalidStatus, match="403"):
        _socket(f"attacker.example:{opened.port}", opened.path, host="127.0.0.1", port=opened.port)


def test_what_is_no_request_leaves_nothing_on_the_terminal(opened: SplitResult) -> None:
    starts = (b"\x00\xff", b"GET /\xff HTTP/1.1\r\nHost: [", b"GET / HTTP/1.1\r\nHost: a\r\nHost: b")
    for start in starts:
        with socket.create_connection(("127.0.0.1", opened.port or 0)) as connection:
            connection.sendall(start + b"\r\n\r\n")
            while connection.recv(4096):
                pass
