"""The installed command, ended by a signal at any moment of its life: whole files, no leftovers, no traceback."""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from resource import RLIM_INFINITY, RLIMIT_FSIZE, setrlimit
from typing import NamedTuple

import pytest

from tests.hostile.injected import Tree, tree
from tests.hostile.test_injected import COMMANDS, Command, environment, prepare
from tests.profile import DEEP
from twinform.storage.staging import PREFIX

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="looks into /proc")
_TWINFORM = Path(sys.executable).with_name("twinform")
_POINTS = 12 if DEEP else 1
"""Moments at which each command is ended."""
_QUICK = {"all files of one"}
_CHANGING = {"one in place", "one into a file", "a reproducer", "one more reproducer"}
"""Commands that do something else when they are run again."""


_NAMES = [name if name in _QUICK else pytest.param(name, marks=pytest.mark.deep) for name in COMMANDS]


class Ended(NamedTuple):
    """How a run ended that was sent a signal, and what it has left."""

    code: int
    errors: str
    tree: Tree
    temporary: Tree


class Runs:
    """Runs of a command, each in a new copy of a folder."""

    def __init__(self, command: Command, top: Path) -> None:
        self._command = command
        self._words = [str(_TWINFORM), *command.words.split()]
        self._template, self.here, self._temporary = top / "template", top / "here", top / "tmp"
        self._template.mkdir()
        prepare(command, self._template)
        self.before = tree(self._template)
        began = time.monotonic()
        clean = self.run()
        self.seconds = time.monotonic() - began
        assert clean.code == command.code, clean.errors
        self.after, self.printed = clean.tree, clean.errors

    def run(
        self, number: signal.Signals | None = None, share: float = 0, times: int = 1, largest: int = RLIM_INFINITY
    ) -> Ended:
        """Run the command, and send it a signal after this share of its life; no file may grow past `largest` bytes."""
        for folder in (self.here, self._temporary):
            shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self._template, self.here, symlinks=True)
        self._temporary.mkdir()
        return self.again(number, share, times, largest)

    def again(
        self, number: signal.Signals | None = None, share: float = 0, times: int = 1, largest: int = RLIM_INFINITY
    ) -> Ended:
        """Run it in the folder as it is."""
        process = subprocess.Popen(
            self._words,
            cwd=self.here,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            env=self._environment(),
            preexec_fn=partial(_begin, largest),  # noqa: PLW1509 - there are no threads
        )
        if number is not None:
            _wait_for_handlers(process)
            time.sleep(share * self.seconds)
            for _ in range(times):
                process.send_signal(number)
        _, errors = process.communicate()
        text = errors.decode(errors="replace")
        return Ended(process.returncode, text, tree(self.here), tree(self._temporary))

    def is_whole(self, ended: Ended) -> bool:
        """Whether all files are old, or all are new; of a command that writes each for itself, whether each is."""
        if ended.code == self._command.code or not self._command.apart:
            return ended.tree in ([self.before, self.after] if ended.code else [self.after])
        names = {*ended.tree, *self.before, *self.after}
        return all(ended.tree.get(name, 0) in {self.before.get(name, 0), self.after.get(name, 0)} for name in names)

    def _environment(self) -> Mapping[str, str]:
        return {**environment(self._template), "TMPDIR": str(self._temporary)}


def _begin(largest: int = RLIM_INFINITY) -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)  # who runs the tests may have it ignored
    setrlimit(RLIMIT_FSIZE, (largest, largest))


def _wait_for_handlers(process: subprocess.Popen[bytes]) -> None:
    """Wait until the program handles SIGTERM: what comes earlier is Python's own start."""
    while process.poll() is None:
        status = Path(f"/proc/{process.pid}/status").read_text()
        caught = re.search(r"^SigCgt:\s*(\w+)", status, re.MULTILINE)
        if caught and int(caught[1], 16) >> (signal.SIGTERM - 1) & 1:
            return
        time.sleep(0.001)


@pytest.mark.parametrize("number", [signal.SIGINT, *([signal.SIGTERM, signal.SIGHUP] if DEEP else [])])
@pytest.mark.parametrize("name", _NAMES)
def test_a_signal_ends_it_with_all_old_or_all_new(name: str, number: signal.Signals, tmp_path: Path) -> None:
    command = COMMANDS[name]
    runs = Runs(command, tmp_path)
    for point in range(_POINTS):
        ended = runs.run(number, (point + 0.5) / _POINTS)
        assert ended.code in {command.code, 128 + number}, ended.errors
        assert "Traceback" not in ended.errors.replace(runs.printed, "")
        assert "Exception ignored" not in ended.errors
        assert ended.temporary == {}
        assert runs.is_whole(ended)


@pytest.mark.parametrize("name", _NAMES)
def test_a_killed_run_leaves_whole_files_and_the_next_run_removes_the_rest(name: str, tmp_path: Path) -> None:
    if name in _CHANGING:
        pytest.skip("it does something else when it is run again")
    runs = Runs(COMMANDS[name], tmp_path)
    for point in range(_POINTS):
        ended = runs.run(signal.SIGKILL, (point + 0.5) / _POINTS)
        for path, content in ended.tree.items():
            if content is not None and PREFIX not in path:
                assert content in {runs.before.get(path), runs.after.get(path), *_marks(path, content)}
        again = runs.again()
        assert again.code == COMMANDS[name].code, again.errors
        assert again.tree == runs.after
        assert again.temporary == {}


def _marks(path: str, content: bytes) -> set[bytes]:
    """The list of a package's files, which is longer while one package takes the place of another."""
    return {content} if path.endswith(".twinform-package") and content.endswith(b"\n") else set()


@pytest.mark.deep
@pytest.mark.parametrize("largest", [0, 100])
@pytest.mark.parametrize("name", COMMANDS)
def test_files_that_may_not_grow_are_not_written(name: str, largest: int, tmp_path: Path) -> None:
    runs = Runs(COMMANDS[name], tmp_path)
    ended = runs.run(largest=largest)
    assert ended.code in {COMMANDS[name].code, 2}, ended.errors
    assert "Traceback" not in ended.errors.replace(runs.printed, "")
    assert ended.code != 2 or "File too large" in ended.errors or "TMPDIR: nothing can be written" in ended.errors
    assert ended.temporary == {}
    assert runs.is_whole(ended)


def test_a_second_interrupt_changes_nothing(tmp_path: Path) -> None:
    runs = Runs(COMMANDS["several"], tmp_path)
    ended = runs.run(signal.SIGINT, 0, times=3)
    assert (ended.code, ended.errors, ended.tree) == (130, "", runs.before)


_ENDLESS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">
<xacro:macro name="m" params="n"><xacro:if value="${n > 0}"><xacro:m n="${n - 1}"/><xacro:m n="${n - 1}"/></xacro:if>
</xacro:macro><xacro:m n="60"/></robot>"""


@pytest.mark.parametrize("number", [signal.SIGKILL, pytest.param(signal.SIGINT, marks=pytest.mark.deep)])
def test_a_child_process_ends_with_the_command(number: signal.Signals, tmp_path: Path) -> None:
    (tmp_path / "r.urdf.xacro").write_text(_ENDLESS)
    command = [_TWINFORM, "check", "r.urdf.xacro"]
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, preexec_fn=_begin) as process:  # noqa: PLW1509 - there are no threads
        child = _child_of(process)
        process.send_signal(number)
        process.wait()
    while _is_running(child):  # the system takes a moment; the child has ten seconds of the processor itself
        assert _seconds_of(child) < 5
        time.sleep(0.01)


@pytest.mark.deep
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_view_ends_with_all_its_processes(number: signal.Signals, tmp_path: Path) -> None:
    prepare(COMMANDS["a conversion"], tmp_path)
    command = [_TWINFORM, "view", "r.urdf", "--no-open"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, preexec_fn=_begin) as process:  # noqa: PLW1509 - there are no threads
        assert process.stdout is not None
        assert process.stdout.readline().startswith(b"showing")
        children = _children_of(process)
        process.send_signal(number)
        assert process.wait() == (-9 if number == signal.SIGKILL else 0)
    for child in children:
        while _is_running(child):
            time.sleep(0.01)


def _children_of(process: subprocess.Popen[bytes]) -> list[int]:
    tasks = Path(f"/proc/{process.pid}/task").glob("*/children")
    return [int(child) for task in tasks for child in task.read_text().split()]


def _child_of(process: subprocess.Popen[bytes]) -> int:
    """The child process of a command, once that has one which is at work."""
    while True:
        for child in _children_of(process):
            if _is_running(child) and _seconds_of(child) > 0.2:
                return child
        time.sleep(0.01)


def _state_of(process: int) -> list[str]:
    return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()


def _is_running(process: int) -> bool:
    try:
        return _state_of(process)[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def _seconds_of(process: int) -> float:
    try:
        return sum(map(int, _state_of(process)[11:13])) / os.sysconf("SC_CLK_TCK")
    except (FileNotFoundError, ProcessLookupError):
        return 0
