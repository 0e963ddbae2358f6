"""Every command of the installed program, with arguments that let it do its work, for tests that ask all of them."""

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from twinform import __version__
from twinform.cli import main

PROGRAM = Path(sys.executable).with_name("twinform")
_SECONDS = 120
_XACRO = """\
<robot name="made" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="wide" value="${load_yaml('sizes.yaml')['wide']}"/>
  <link name="base"><visual><geometry><box size="${wide} 1 1"/></geometry></visual></link>
</robot>
"""
_CUBE = """\
<robot name="cube">
  <link name="base">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><geometry><mesh filename="cube.obj"/></geometry></collision>
  </link>
</robot>
"""
_OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
_REPRODUCER = {
    "twinform": __version__,
    "python": "3.11",
    "source": "cube.urdf",
    "fault": "exception",
    "error": "no parts",
    "traceback": "",
    "again": True,
    "pipeline": "fill-inertia",
    "document": {"format": "urdf", "models": [{"name": "cube", "links": [{"name": "base"}]}]},
}
FILES: Mapping[str, str] = {
    "cube.urdf": _CUBE,
    "cube.obj": _OBJ,
    "made.urdf.xacro": _XACRO,
    "sizes.yaml": "wide: 2\n",
    "models/cube.urdf": _CUBE,
    "models/cube.obj": _OBJ,
    "models/made.urdf.xacro": _XACRO,
    "models/sizes.yaml": "wide: 2\n",
    "fuel/model.config": "<model><name>f</name><version>1</version><sdf version='1.9'>model.sdf</sdf></model>",
    "fuel/model.sdf": "<sdf version='1.9'><model name='f'><link name='l'/></model></sdf>",
    "fault.json": json.dumps(_REPRODUCER),
}
INVOCATIONS: Mapping[str, Sequence[str]] = {
    "advise": ["advise cube.urdf"],
    "batch check": ["batch check models --jobs 1"],
    "batch convert": ["batch convert models made --to sdf --jobs 1"],
    "batch diff": ["batch diff models models --jobs 1"],
    "batch merge": ["batch merge made made"],
    "batch stats": ["batch stats models --jobs 1"],
    "clean": ["clean"],
    "check": [
        "check cube.urdf made.urdf.xacro",
        "check models --jobs 2",
        "check --fix --diff cube.urdf",
        "check --format github cube.urdf",
    ],
    "convert": ["convert made.urdf.xacro --to sdf", "convert cube.urdf --to sdf --passes fill-inertia"],
    "diff": ["diff cube.urdf made.urdf.xacro"],
    "explain": ["explain", "explain world-child"],
    "fix": ["fix --diff cube.urdf"],
    "format": ["format --check cube.urdf", "format --diff cube.urdf"],
    "fuel add": ["fuel add fuel --owner somebody --cache cache"],
    "fuel list": ["fuel list --cache cache"],
    "graph": ["graph cube.urdf"],
    "lsp": ["lsp"],
    "mcp": ["mcp"],
    "merge": ["merge cube.urdf cube.urdf cube.urdf -o merged.urdf"],
    "package": ["package cube.urdf -o packaged --kind both"],
    "passes": ["passes", "passes fill-inertia"],
    "report": ["report cube.urdf -o report.html", "report cube.urdf --format md"],
    "reproduce": ["reproduce fault.json"],
    "schema": ["schema urdf"],
    "stats": ["stats cube.urdf"],
    "sync": ["sync cube.urdf synced.sdf", "sync cube.urdf synced.sdf --check"],
    "view": ["view cube.urdf --no-open"],
}
"""The calls of each command, in the order in which they run; later ones find the files that earlier ones made."""


def commands(group: click.Group = main, above: str = "") -> Iterator[str]:
    """Yield the name of each command that does something, with those of its groups before it."""
    context = click.Context(group)
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        if isinstance(command, click.Group):
            yield from commands(command, f"{above}{name} ")
        else:
            yield f"{above}{name}"


@dataclass(frozen=True, slots=True)
class Printed:
    """How a command ended, and what it printed."""

    code: int
    output: bytes
    errors: bytes


def run(words: Sequence[str], folder: Path, environment: Mapping[str, str] | None = None) -> Printed:
    """Run the installed program in a folder; an editor talks to `lsp`, and `view` is asked to end once it listens."""
    process = subprocess.Popen(
        [PROGRAM, *words],
        cwd=folder,
        env={**os.environ, **(environment or {})},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    timer = threading.Timer(_SECONDS, process.kill)
    timer.start()
    try:
        match words[0]:
            case "lsp":
                before = _edit(process, folder)
            case "view":
                before = _look(process)
            case _:
                before = b""
        output, errors = process.communicate()
    finally:
        timer.cancel()
        process.kill()
    return Printed(process.returncode, before + output, errors)


def _look(process: subprocess.Popen[bytes]) -> bytes:
    """Wait until a viewer says where it listens, and ask it to end."""
    assert process.stdout is not None
    process.stdout.readline()  # it has an address of its own each time
    process.send_signal(signal.SIGTERM)
    return b""


def _edit(process: subprocess.Popen[bytes], folder: Path) -> bytes:
    """Open a file as an editor does, wait for its diagnostics, and end the server; return the diagnostics."""
    root, document = folder.as_uri(), (folder / "cube.urdf").as_uri()
    _send(process, {"id": 1, "method": "initialize", "params": {"capabilities": {}, "rootUri": root}})
    _answer(process, lambda message: message.get("id") == 1)
    _send(process, {"method": "initialized", "params": {}})
    item = {"uri": document, "languageId": "urdf", "version": 1, "text": _CUBE}
    _send(process, {"method": "textDocument/didOpen", "params": {"textDocument": item}})
    found = _answer(process, lambda message: message.get("method") == "textDocument/publishDiagnostics")
    _send(process, {"id": 2, "method": "shutdown"})
    _answer(process, lambda message: message.get("id") == 2)
    _send(process, {"method": "exit"})
    return json.dumps(found["params"]["diagnostics"]).encode()


def _send(process: subprocess.Popen[bytes], message: Mapping[str, object]) -> None:
    assert process.stdin is not None
    data = json.dumps({"jsonrpc": "2.0", **message}).encode()
    process.stdin.write(b"Content-Length: %d\r\n\r\n%b" % (len(data), data))
    process.stdin.flush()


def _answer(process: subprocess.Popen[bytes], is_it: Callable[[Mapping[str, Any]], bool]) -> Mapping[str, Any]:
    """Read what a server says, until it is what is waited for."""
    assert process.stdout is not None
    while True:
        length = 0
        while (line := process.stdout.readline()) not in {b"\r\n", b""}:
            name, _, value = line.partition(b":")
            length = int(value) if name.lower() == b"content-length" else length
        assert line, "the server has ended"
        message = json.loads(process.stdout.read(length))
        if is_it(message):
            return message
