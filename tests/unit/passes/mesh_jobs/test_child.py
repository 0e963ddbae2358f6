"""The fork that does a job on a mesh: what it may not do, and what is said where it dies."""

import io
import json
import subprocess
import sys

import pytest

from twinform.passes.mesh_jobs.child import do_job
from twinform.passes.mesh_jobs.child_process import MeshProcess
from twinform.passes.mesh_jobs.job import BadMessageError, MeshJob, MeshResult, pack_message, unpack_message

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="it forks on Linux alone"),
]
_SCRIPT = """
import os, socket, sys, threading
from twinform.passes.mesh_jobs import child
from twinform.passes.mesh_jobs.job import MeshJob, MeshResult

def tried(what):
    try:
        what()
    except OSError:
        return False
    return True

def started():
    thread = threading.Thread(target=int)
    thread.start()
    thread.join()

def do_job(job):
    tries = {
        "read": lambda: open("/etc/passwd"), "list": lambda: os.listdir("/"), "write": lambda: open("/tmp/x", "w"),
        "connect": socket.socket, "fork": os.fork, "signal": lambda: os.kill(os.getppid(), 0), "thread": started,
    }
    return MeshResult({name: tried(each) for name, each in tries.items()})

child._import_libraries()
child.do_job = do_job
child._do_in_fork(MeshJob("count", {}, "stl", b""), 2**32, sys.stdout.buffer)
"""
_DEATHS = {
    "while True: pass": "reading it takes more than 1 seconds of the processor",
    "import os; os.abort()": "the process that looks into it died",
    "import sys; sys.exit(3)": "the process that looks into it died",
}


def _replied(script: str) -> MeshResult:
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, check=True)
    return MeshResult.read(io.BytesIO(done.stdout))


def test_it_opens_nothing_and_starts_nothing_but_threads() -> None:
    from twinform.confinement import kernel  # noqa: PLC0415 - not everywhere

    facts = _replied(_SCRIPT).facts
    kernel = subprocess.run(
        [sys.executable, "-c", f"import {kernel.__name__} as l; print(l.renounce_files())"],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    if kernel.stdout.strip() != "True":
        pytest.skip("this kernel has no Landlock")
    assert {name for name, worked in facts.items() if worked} == {"thread"}


@pytest.mark.parametrize("code", _DEATHS)
def test_a_death_is_told_from_another(code: str) -> None:
    dying = f"def do_job(job):\n    {code}\n"
    script = f"{_SCRIPT[: _SCRIPT.index('def tried')]}{dying}{_SCRIPT[_SCRIPT.index('child._import') :]}"
    result = _replied(script)
    assert (result.trouble, result.message[: len(_DEATHS[code])]) == ("unreadable", _DEATHS[code])


def test_one_death_ends_no_other_job() -> None:
    process = MeshProcess()
    try:
        faces = b"".join(b"f" + b" 1 2 3" * 300 + b"\n" for _ in range(3_000))
        worse = process.do(MeshJob("count", {}, "obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\n" + faces))
        assert worse.trouble == "unreadable" or worse.facts["triangles"]
        assert process.do(MeshJob("count", {}, "off", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).facts == {
            "triangles": 1
        }
    finally:
        process.end()


@pytest.mark.parametrize("sizes", [[2**40], [-1], [2**29] * 3, ["x"], [[]]])
def test_a_message_with_too_much_is_none(sizes: list[object]) -> None:
    text = json.dumps({"sizes": sizes}).encode()
    with pytest.raises(BadMessageError):
        unpack_message(io.BytesIO(len(text).to_bytes(8, "big") + text))
    assert unpack_message(io.BytesIO(pack_message({"a": 1}, [b"x"]))) == ({"a": 1}, [b"x"])


def test_a_long_message_of_a_library_is_cut() -> None:
    found = do_job(MeshJob("count", {}, "off", b"OFF\n" + b"x" * 10_000))
    assert found.trouble == "unreadable"
    assert len(found.message) < 1000
