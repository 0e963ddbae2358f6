"""How the program ends: fast, and with all that Python's own end would have done."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = "from twinform.cli.process import run\n"
BUFFERED = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}


LEFT = "left\n"
NOTED = """import os
_leave = os._exit
def _noted(code): os.write(1, b"left\\n"), _leave(code)
os._exit = _noted
"""


def _run(body: str, *options: str) -> subprocess.CompletedProcess[str]:
    """Run a command; `left` stands last in its output where Python was not taken down."""
    return subprocess.run(
        [sys.executable, *options, "-c", f"{PROGRAM}{NOTED}{body}\nrun(command)"],
        capture_output=True,
        text=True,
        check=False,
    )


def _ending(code: str, before: str = "pass") -> str:
    return f"import sys\ndef command():\n    {before}\n    sys.exit({code})"


@pytest.mark.parametrize(("code", "expected"), [("0", 0), ("1", 1), ("2", 2), ("141", 141), ("None", 0), ("256", 0)])
def test_the_exit_code_is_that_of_the_command(code: str, expected: int) -> None:
    done = _run(_ending(code))
    assert (done.returncode, done.stdout) == (expected, LEFT)


def test_a_message_is_printed() -> None:
    done = _run(_ending("'went wrong'"))
    assert (done.returncode, done.stdout, done.stderr.strip()) == (1, "", "went wrong")


def test_what_is_in_the_buffers_is_written() -> None:
    done = _run(_ending("0", "print('out', end=''); print('err', end='', file=sys.stderr)"))
    assert (done.stdout, done.stderr) == (f"out{LEFT}", "err")


def test_handlers_at_exit_run_in_their_order() -> None:
    body = "import atexit\natexit.register(print, 'first')\natexit.register(print, 'last')\n"
    assert _run(body + _ending("3")).stdout == f"last\nfirst\n{LEFT}"


def test_a_handler_that_fails_changes_no_exit_code() -> None:
    done = _run("import atexit\natexit.register(lambda: 1 / 0)\n" + _ending("3"))
    assert done.returncode == 3
    assert "ZeroDivisionError" in done.stderr


def test_temporary_folders_are_removed(tmp_path: Path) -> None:
    body = f"import tempfile\nfolder = tempfile.TemporaryDirectory(dir={str(tmp_path)!r})\n"
    assert _run(body + _ending("0")).returncode == 0
    assert not list(tmp_path.iterdir())


def test_threads_that_are_no_daemons_are_waited_for() -> None:
    body = "import threading, time\ndef work():\n    time.sleep(0.3); print('done')\n"
    done = _run(body + _ending("4", "threading.Thread(target=work).start()"))
    assert (done.returncode, done.stdout) == (4, "done\n")


def test_daemons_are_not_waited_for() -> None:
    body = "import threading, time\n"
    done = _run(body + _ending("4", "threading.Thread(target=time.sleep, args=(60,), daemon=True).start()"))
    assert (done.returncode, done.stdout) == (4, LEFT)


@pytest.mark.parametrize("watch", ["sys.settrace(lambda *_: None)", "sys.setprofile(lambda *_: None)"])
def test_who_watches_sees_the_end(watch: str) -> None:
    done = _run(_ending("5", watch))
    assert (done.returncode, done.stdout) == (5, "")


@pytest.mark.skipif(sys.version_info < (3, 12), reason="Python has it since 3.12")
def test_who_monitors_sees_the_end() -> None:
    assert _run(_ending("5", "sys.monitoring.use_tool_id(2, 'profiler')")).stdout == ""


def test_development_mode_sees_the_end() -> None:
    assert _run(_ending("5"), "-X", "dev").stdout == ""


def test_another_exception_ends_as_ever() -> None:
    done = _run("def command():\n    raise ValueError('a bug')")
    assert (done.returncode, done.stdout) == (1, "")
    assert "ValueError: a bug" in done.stderr


def test_a_command_that_returns_is_a_success() -> None:
    assert _run("def command():\n    return 5").returncode == 0


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="Linux has it")
@pytest.mark.parametrize("leave", ["run(command)", "command()"])
def test_a_full_disk_gives_the_exit_code_that_python_gives(leave: str) -> None:
    program = f"{PROGRAM}{_ending('0', 'print(1)')}\n{leave}"
    with Path("/dev/full").open("w") as full:
        command = [sys.executable, "-c", program]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, env=BUFFERED, check=False)
    assert done.returncode == 120
    assert b"No space left" in done.stderr


@pytest.mark.parametrize("leave", ["run(command)", "command()"])
def test_a_closed_pipe_gives_the_exit_code_that_python_gives(leave: str) -> None:
    program = f"{PROGRAM}{_ending('0', 'sys.stdin.read(); print(1)')}\n{leave}"
    command = [sys.executable, "-c", program]
    pipe, nowhere = subprocess.PIPE, subprocess.DEVNULL
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=nowhere, env=BUFFERED) as process:
        assert process.stdin
        assert process.stdout
        process.stdout.close()
        process.stdin.close()
        assert process.wait() == 120


@pytest.mark.parametrize("closed", [">&-", "2>&-", "<&-", ">&- 2>&- <&-"])
def test_closed_streams_are_no_matter(closed: str) -> None:
    program = f"{PROGRAM}{_ending('7')}\nrun(command)"
    done = subprocess.run(["sh", "-c", f'exec "$0" -c "$1" {closed}', sys.executable, program], check=False)
    assert done.returncode == 7
