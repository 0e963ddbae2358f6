"""`check` and `format` in several processes: what they print is the same, and no process outlives the command."""

import os
import shutil
import signal
import subprocess
import time
from pathlib import Path

import pytest

from tests.hostile.every_command import PROGRAM

_TEXTS = {
    "good": '<robot name="r"><link name="base"/></robot>\n',
    "warned": '<robot name="r"><link name="base"><color/></link></robot>\n',
    "wrong": '<robot name="r"><link name="a"/><joint name="j" type="fixed"><parent link="a"/></joint></robot>\n',
    "cut": '<robot name="r"><link name="base">\n',
}
_XACRO = """\
<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="n" value="{}"/><link name="base"/>{}
</robot>
"""


@pytest.fixture
def models(tmp_path: Path) -> Path:
    """Sixty models of several kinds, good and bad, and one that takes long."""
    for number in range(15):
        for name, text in _TEXTS.items():
            (tmp_path / f"{number:02}_{name}.urdf").write_text(text)
    (tmp_path / "made.urdf.xacro").write_text(_XACRO.format("${1 / 0}", ""))
    return tmp_path


def _run(folder: Path, *arguments: str, seconds: float = 120) -> tuple[int, bytes, bytes]:
    done = subprocess.run(
        [PROGRAM, *arguments], cwd=folder, capture_output=True, check=False, timeout=seconds, env=_environment()
    )
    return done.returncode, done.stdout, done.stderr


def _environment() -> dict[str, str]:
    return {**os.environ, "TWINFORM_CACHE_DIR": "off"}


@pytest.mark.parametrize(
    "options", [["--format", style] for style in ("text", "json", "sarif", "github")] + [["--notes"]]
)
def test_what_is_found_is_the_same_in_one_process_and_in_several(models: Path, options: list[str]) -> None:
    alone = _run(models, "check", ".", "--jobs", "1", *options)
    assert alone[0] == 1
    assert _run(models, "check", ".", "--jobs", "3", *options) == alone
    assert _run(models, "check", ".", *options) == alone  # as many as there are processors


def test_a_baseline_and_an_error_of_the_command_are_the_same(models: Path) -> None:
    baselines = [models / f"baseline{jobs}.json" for jobs in "13"]
    for jobs, file in zip("13", baselines, strict=True):
        assert _run(models, "check", ".", "--jobs", jobs, "--baseline", file.name, "--update-baseline")[0] == 0
    assert baselines[0].read_bytes() == baselines[1].read_bytes()
    (models / "00_good.urdf").write_text(_TEXTS["warned"])
    for options in (["--baseline", "baseline1.json"], ["--passes", "fill-inertia"]):
        alone = _run(models, "check", ".", "--jobs", "1", *options)
        assert _run(models, "check", ".", "--jobs", "3", *options) == alone


def test_what_is_formatted_is_the_same(models: Path) -> None:
    assert _run(models, "format", ".", "--diff", "--jobs", "1") == _run(models, "format", ".", "--diff", "--jobs", "3")
    shutil.copytree(models, models / "copy")
    for jobs in "13":
        folder = models if jobs == "1" else models / "copy"
        assert _run(folder, "format", *sorted(path.name for path in folder.glob("*.urdf")), "--jobs", jobs)[0] == 2
    for path in models.glob("*.urdf"):
        assert path.read_bytes() == (models / "copy" / path.name).read_bytes()


_TWICE = """
<xacro:macro name="twice" params="n">
  <xacro:if value="${n}"><xacro:twice n="${n - 1}"/><xacro:twice n="${n - 1}"/></xacro:if>
</xacro:macro>
<xacro:twice n="30"/>
"""
_SLOW = _XACRO.format("0", _TWICE)
"""Takes all the time that the expansion of a file may take."""


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="processes are found there")
def test_ctrl_c_ends_all_processes(models: Path) -> None:
    for number in range(4):
        (models / f"slow{number}.urdf.xacro").write_text(_SLOW)
    command = subprocess.Popen(
        [PROGRAM, "check", ".", "--jobs", "2"],
        cwd=models,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        env=_environment(),
        start_new_session=True,
    )
    _wait_for(lambda: len(_processes_in(command.pid)) >= 4)  # with those that expand xacro
    command.send_signal(signal.SIGINT)
    assert command.wait(20) == 130
    _wait_for(lambda: not _processes_in(command.pid))


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="processes are found there")
def test_a_process_that_dies_is_a_finding_about_its_file(models: Path) -> None:
    (models / "made.urdf.xacro").rename(models / "a_slow.urdf.xacro")
    (models / "a_slow.urdf.xacro").write_text(_SLOW)
    command = subprocess.Popen(
        [PROGRAM, "check", ".", "--jobs", "2"],
        cwd=models,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=_environment(),
        start_new_session=True,
        text=True,
    )
    found: list[int] = []
    _wait_for(lambda: bool(found.extend(_workers_with_children(command.pid)) or found))
    os.kill(found[0], signal.SIGKILL)
    printed, summary = command.communicate(timeout=120)
    assert command.returncode == 1
    assert "a_slow.urdf.xacro: error: the file could not be checked: the process died" in printed
    assert "61 files" in summary


def _processes_in(session: int) -> list[int]:
    """The processes of a session that are not the first."""
    return [pid for pid, fields in _table() if int(fields[3]) == session and pid != session and fields[0] != "Z"]


def _workers_with_children(session: int) -> list[int]:
    """The processes of a session, but for the first, that have started one themselves: they expand xacro."""
    parents = {int(fields[1]) for _, fields in _table() if int(fields[3]) == session}
    return [pid for pid in _processes_in(session) if pid in parents]


def _table() -> list[tuple[int, list[str]]]:
    """The processes with what stands behind their names in `/proc/PID/stat`."""
    found: list[tuple[int, list[str]]] = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            found.append((int(path.parent.name), path.read_text().rpartition(")")[2].split()))
        except OSError:
            continue
    return found


def _wait_for(condition: "object", seconds: float = 60) -> None:
    end = time.monotonic() + seconds
    assert callable(condition)
    while not condition():
        assert time.monotonic() < end, "it took too long"
        time.sleep(0.05)
