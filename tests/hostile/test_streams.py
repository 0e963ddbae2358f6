"""Standard output that is full, closed, or read by nobody: an error in words, never a traceback, and no file."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from testbed import robots

_CRATE = Path(__file__).parents[2] / "examples" / "crate"
_PROGRAM = Path(sys.executable).with_name("twinform")
_TWINFORM = f"{sys.executable} -c 'from twinform.cli import main; main()'"
COMMANDS = {
    **{f"check as {style}": f"check --format {style} bad.urdf" for style in ("text", "json", "sarif", "github")},
    **{f"stats as {style}": f"stats --format {style} good.urdf" for style in ("text", "json")},
    **{f"diff as {style}": f"diff --format {style} good.urdf other.urdf" for style in ("text", "json")},
    "a conversion": "convert good.urdf",
    "a plan": "convert good.urdf --print-pipeline",
    "rules": "explain",
    "passes": "passes --format json",
    "a schema": "schema urdf",
    "fuel add": "fuel add crate --owner somebody --cache cache",
    "help": "--help",
    "the version": "--version",
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    shutil.copytree(_CRATE, tmp_path / "crate")
    (tmp_path / ".git").mkdir()
    (tmp_path / "good.urdf").write_text(robots.urdf(2))
    (tmp_path / "other.urdf").write_text(robots.urdf(3))
    (tmp_path / "bad.urdf").write_text('<robot name="r"><link name="a"/><link name="a"/></robot>')
    return tmp_path


def _run(command: str, where: str, folder: Path) -> subprocess.CompletedProcess[str]:
    line = f"set -o pipefail; {_TWINFORM} {command} {where}"
    return subprocess.run(["bash", "-c", line], cwd=folder, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("where", [">/dev/full", pytest.param(">&-", marks=pytest.mark.deep)])
@pytest.mark.parametrize("name", COMMANDS)
def test_output_that_cannot_be_written_is_an_error_with_a_message(name: str, where: str, folder: Path) -> None:
    done = _run(COMMANDS[name], where, folder)
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1].startswith("Error: cannot write standard output: ")
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr


@pytest.mark.parametrize("name", ["check as json", "a conversion"])
def test_closed_output_is_an_error_too(name: str, folder: Path) -> None:
    done = _run(COMMANDS[name], ">&-", folder)
    assert (done.returncode, done.stderr) == (2, "Error: cannot write standard output: it is closed\n")


@pytest.mark.parametrize(
    "name",
    [name if name in {"a conversion", "help"} else pytest.param(name, marks=pytest.mark.deep) for name in COMMANDS],
)
def test_a_reader_that_has_read_enough_ends_it_quietly(name: str, folder: Path) -> None:
    done = _run(COMMANDS[name], "| true", folder)
    assert (done.returncode, done.stderr) == (141, "")


@pytest.mark.parametrize("instruction", ["bash_source", "bash_complete"])
def test_a_shell_that_asks_for_completions_and_goes_is_no_error(
    instruction: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name, value in (("_TWINFORM_COMPLETE", instruction), ("COMP_WORDS", "twinform conv"), ("COMP_CWORD", "1")):
        monkeypatch.setenv(name, value)
    line = f"set -o pipefail; {_PROGRAM} | true"
    done = subprocess.run(["bash", "-c", line], cwd=folder, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (141, "")


def test_no_file_is_written_where_the_text_is_not(folder: Path) -> None:
    files = "--ledger ledger.json --bridge bridge.yaml --world world.sdf"
    before = sorted(folder.iterdir())
    assert _run(f"convert good.urdf {files}", ">/dev/full", folder).returncode == 2
    assert sorted(folder.iterdir()) == before
    assert _run(f"convert good.urdf {files}", "", folder).returncode == 0
    assert len(sorted(folder.iterdir())) == len(before) + 3


def test_no_file_takes_the_place_of_a_closed_stream(folder: Path) -> None:
    """What is printed to a stream that was closed once went into the file that was opened next."""
    done = _run("convert good.urdf -o good.sdf --notes", "<&- >&- 2>&-", folder)
    assert done.returncode == 0
    assert (folder / "good.sdf").read_text() == _run("convert good.urdf", "", folder).stdout


@pytest.mark.parametrize("closed", ["2>&-", pytest.param("<&- >&- 2>&-", marks=pytest.mark.deep)])
def test_child_processes_start_where_a_stream_is_closed(closed: str, folder: Path) -> None:
    assert _run("batch convert . out --to sdf --jobs 1 --quiet", closed, folder).returncode == 1  # `bad.urdf` is there
    assert (folder / "out" / "good.sdf").exists()
