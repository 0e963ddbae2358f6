"""Folders of models for long runs, and runs of the command in processes of their own."""

import os
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from testbed import robots

_PROGRAM = (sys.executable, "-c", "from twinform.cli import main; main()")
_CRATE = '<sdf version="1.11"><model name="crate"><link name="base"/></model></sdf>'
_WORLD = '<sdf version="1.11"><world name="w"><include><uri>model://crate</uri></include></world></sdf>'
_XACRO = '<robot name="x" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="${2 * 3}"/></robot>'
_WRONG = '<robot name="r"><link name="a"/><link name="a"/></robot>'


def converting(*words: str, out: str = "out") -> list[str]:
    """The command that converts all models of the folder `src`."""
    return [*_PROGRAM, "batch", "convert", "src", out, "--to", "sdf", "--expand-includes", *words]


def results(out: str = "out") -> dict[str, bytes]:
    """Every result by its place."""
    found = (path for path in Path(out).rglob("*") if path.is_file() and ".twinform-batch" not in path.parts)
    return {path.relative_to(out).as_posix(): path.read_bytes() for path in found}


def records(out: str = "out") -> int:
    """How many lines the manifest has."""
    path = Path(out, ".twinform-batch/manifest.jsonl")
    return path.read_bytes().count(b"\n") if path.is_file() else 0


def finish(command: Sequence[str], *, code: int = 1) -> str:
    """Run a command to its end; gives the last line of its stderr."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600)
    assert done.returncode == code, done.stderr
    return done.stderr.splitlines()[-1]


def wait_for(condition: Callable[[], bool], seconds: float = 60) -> None:
    """Wait until it is so."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A current folder with a hundred models in `src`: of one file, with includes, of xacro, and wrong ones."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "src/crate").mkdir(parents=True)
    (tmp_path / "src/.git").mkdir()
    texts = {f"r{number:02}.urdf": robots.urdf(5 + number % 7) for number in range(80)}
    texts |= {f"w{number}.world": _WORLD for number in range(9)} | {
        f"x{number}.urdf.xacro": _XACRO for number in range(5)
    }
    texts |= {f"no{number}.urdf": _WRONG for number in range(5)} | {"crate/model.sdf": _CRATE}
    texts["crate/model.config"] = '<model><sdf version="1.11">model.sdf</sdf></model>'
    old = time.time() - 100
    for name, text in texts.items():
        (tmp_path / "src" / name).write_text(text)
        os.utime(tmp_path / "src" / name, (old, old))
    return tmp_path


SUMMARY = "100 models: 95 converted, 5 refused"
