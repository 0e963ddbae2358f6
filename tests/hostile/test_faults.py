"""Whatever happens while files are written: the old ones stay, or the new ones are complete."""

import os
import resource
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from lxml import etree

from testbed import robots

_COMMAND = [sys.executable, "-c", "from twinform.cli import main; main()"]
_SIGNALLED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # who runs the tests may have it ignored
real = os.{call}
def call(*args, **more):
    os.kill(os.getpid(), signal.{name})
    return real(*args, **more)
os.{call} = call
from twinform.cli import main
main()
"""
_OLD = "as it was"
_WORLD = """<sdf version="1.11"><world name="w">
<model name="one"><link name="l"/></model><model name="two"><link name="l"/></model></world></sdf>"""


@pytest.fixture
def source(tmp_path: Path) -> Path:
    path = tmp_path / "robot.urdf"
    path.write_text(robots.urdf(20))
    return path


def _names(folder: Path) -> set[str]:
    return {each.name for each in folder.iterdir()}


def _run(
    *words: str | Path, program: str = "", limit: Callable[[], None] | None = None
) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", program] if program else _COMMAND
    return subprocess.run(
        [*command, "convert", *map(str, words)], capture_output=True, text=True, preexec_fn=limit, check=False
    )


def _full() -> None:
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))


def test_a_full_disk_leaves_the_old_file_and_no_other(source: Path) -> None:
    out, ledger = source.with_suffix(".sdf"), source.with_suffix(".json")
    out.write_text(_OLD)
    done = _run(source, "-o", out, "--ledger", ledger, limit=_full)
    assert (done.returncode, out.read_text()) == (2, _OLD)
    assert f"cannot write {out}" in done.stderr
    assert _names(out.parent) == {"robot.urdf", "robot.sdf"}


def test_a_ledger_that_cannot_be_written_keeps_the_output_back(source: Path) -> None:
    out = source.with_suffix(".sdf")
    done = _run(source, "-o", out, "--ledger", source / "ledger.json")
    assert done.returncode == 2
    assert f"cannot write {source}/ledger.json: a file stands where its folder would be" in done.stderr
    assert _names(source.parent) == {"robot.urdf"}


def test_a_device_that_is_full_is_an_error(source: Path) -> None:
    done = _run(source, "-o", "/dev/full")
    assert (done.returncode, "cannot write /dev/full" in done.stderr) == (2, True)


def test_a_pipe_is_written_into_and_never_replaced(source: Path, tmp_path: Path) -> None:
    """As root, a conversion to /dev/null once left a file in its place."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE) as reader:
        done = _run(source, "--to", "sdf", "-o", pipe)
        output = reader.stdout.read() if reader.stdout else b""
    assert (done.returncode, pipe.is_fifo()) == (0, True)
    assert etree.fromstring(output).tag == "sdf"


def test_a_pipe_is_read_once(source: Path) -> None:
    """The shell gives the output of a command as such a file; a look at its beginning once took that away."""
    command = f"{sys.executable} -c 'from twinform.cli import main; main()' convert <(cat {source})"
    done = subprocess.run(["bash", "-c", command], capture_output=True, check=False)
    assert etree.fromstring(done.stdout).tag == "sdf", done.stderr


def test_a_folder_that_takes_no_files_is_an_error(source: Path) -> None:
    if os.geteuid():
        (source.parent / "closed").mkdir(mode=0o500)
    folder = source.parent / "closed" if os.geteuid() else Path("/proc/self")  # root may write in any other
    done = _run(source, "-o", folder / "robot.sdf")
    assert (done.returncode, "cannot write" in done.stderr) == (2, True)


def test_an_input_is_replaced_only_in_place_and_survives_a_full_disk(source: Path) -> None:
    before = source.read_text()
    assert _run(source, "--to", "urdf", "-o", source).returncode == 2
    assert _run(source, "--in-place", limit=_full).returncode == 2
    assert source.read_text() == before
    assert _run(source, "--in-place").returncode == 0
    assert etree.fromstring(source.read_bytes()).tag == "robot"
    assert _names(source.parent) == {"robot.urdf"}


def test_two_writers_leave_one_complete_file(source: Path) -> None:
    out = source.with_suffix(".sdf")
    command = [*_COMMAND, "convert", str(source), "-o", str(out)]
    writers = [subprocess.Popen(command, stderr=subprocess.DEVNULL) for _ in range(4)]
    assert [writer.wait() for writer in writers] == [0] * 4
    assert out.read_text() == _run(source, "--to", "sdf").stdout
    assert _names(source.parent) == {"robot.urdf", "robot.sdf"}


@pytest.mark.parametrize("call", ["fsync", "replace"])
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGKILL"])
def test_a_signal_at_the_worst_moment_leaves_the_old_file(name: str, call: str, source: Path) -> None:
    out = source.with_suffix(".sdf")
    out.write_text(_OLD)
    done = _run(source, "-o", out, program=_SIGNALLED.format(name=name, call=call))
    assert done.returncode not in {0, 2}
    assert out.read_text() == _OLD
    left = _names(source.parent) - {"robot.urdf", "robot.sdf"}
    assert left == set() or name == "SIGKILL"  # nobody can clean up after that


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_a_signal_between_two_moves_takes_the_first_back(name: str, source: Path) -> None:
    out, ledger = source.with_suffix(".sdf"), source.with_suffix(".json")
    out.write_text(_OLD)
    later = _SIGNALLED.replace("    os.kill", "    if str(args[1]).endswith('.json'): os.kill")
    done = _run(source, "-o", out, "--ledger", ledger, program=later.format(name=name, call="replace"))
    assert done.returncode not in {0, 2}
    assert out.read_text() == _OLD
    assert _names(source.parent) == {"robot.urdf", "robot.sdf"}


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGKILL"])
def test_a_split_that_is_stopped_leaves_whole_files(name: str, tmp_path: Path) -> None:
    (tmp_path / "w.sdf").write_text(_WORLD)
    out = tmp_path / "out"
    done = _run(tmp_path / "w.sdf", "--split", "-o", out, program=_SIGNALLED.format(name=name, call="fsync"))
    assert done.returncode not in {0, 2}
    assert not out.exists() or [each for each in _names(out) if not each.startswith(".")] == []


@pytest.mark.deep
@pytest.mark.parametrize("seconds", [each / 40 for each in range(8, 60)])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_signal_at_any_moment_leaves_a_whole_file(number: signal.Signals, seconds: float, source: Path) -> None:
    out = source.with_suffix(".sdf")
    out.write_text(_OLD)
    with subprocess.Popen([*_COMMAND, "convert", str(source), "-o", str(out)], stderr=subprocess.DEVNULL) as running:
        try:
            running.wait(seconds)
        except subprocess.TimeoutExpired:
            running.send_signal(number)
    text = out.read_text()
    assert text == _OLD or etree.fromstring(text.encode()).tag == "sdf"
