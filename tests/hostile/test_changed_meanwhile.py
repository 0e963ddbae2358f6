"""Files that somebody else changes while a command is at work on them."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.hostile.injected import tree
from tests.hostile.test_injected import COMMANDS, Command, prepare
from tests.profile import DEEP

_MEANWHILE = """
import os, signal, sys
count, real = 0, os.{call}
def call(*args, **more):
    global count
    count += 1
    if count == {number}:
        {what}
    return real(*args, **more)
os.{call} = call
from twinform.cli import main
main()
"""
_EDIT = "open('odd.urdf', 'a').write('<!-- mine -->')"
_MOVE = "os.rename('out', 'moved'), os.symlink('elsewhere', 'out')"
_KILL = "os.kill(os.getpid(), signal.SIGKILL)"
_CHANGING = {
    "format": Command("format odd.urdf"),
    "fix": Command("fix odd.urdf"),
    "check --fix": Command("check odd.urdf --fix"),
    "in place": Command("convert odd.urdf --in-place --passes prefix-names{prefix=x_}"),
    "into": Command(
        "convert o.sdf --into odd.urdf", ("convert odd.urdf -o o.sdf", "fix o.sdf --passes prefix-names{prefix=x_}")
    ),
}
_QUICK = {"format", "in place"}


def _run(command: Command, folder: Path, what: str, call: str = "fsync", number: int = 1) -> tuple[int, str]:
    program = _MEANWHILE.format(call=call, number=number, what=what)
    done = subprocess.run(
        [sys.executable, "-c", program, *command.words.split()], cwd=folder, capture_output=True, text=True, check=False
    )
    return done.returncode, done.stderr


@pytest.mark.parametrize(
    "name", [name if name in _QUICK else pytest.param(name, marks=pytest.mark.deep) for name in _CHANGING]
)
def test_nothing_is_written_over_what_somebody_has_changed_meanwhile(name: str, tmp_path: Path) -> None:
    prepare(_CHANGING[name], tmp_path)
    before = tree(tmp_path)
    code, errors = _run(_CHANGING[name], tmp_path, _EDIT)
    assert (code, "odd.urdf has changed since it was read" in errors) == (2, True), errors
    assert tree(tmp_path) == {**before, "odd.urdf": (before["odd.urdf"] or b"") + b"<!-- mine -->"}


def test_nothing_goes_where_a_folder_leads_that_became_a_link(tmp_path: Path) -> None:
    prepare(COMMANDS["several"], tmp_path)
    (tmp_path / "elsewhere").mkdir()
    code, errors = _run(COMMANDS["several"], tmp_path, _MOVE)
    assert (code, "cannot write" in errors) == (2, True), errors
    assert [*(tmp_path / "elsewhere").iterdir()] == []


@pytest.mark.parametrize("number", range(1, 9) if DEEP else [3])
def test_a_package_that_was_killed_half_way_can_be_made_again(number: int, tmp_path: Path) -> None:
    command = COMMANDS["a model folder again"]
    prepare(command, tmp_path)
    code, _ = _run(command, tmp_path, _KILL, "replace", number)
    assert code in {0, -signal.SIGKILL}
    subprocess.run(
        [sys.executable, "-m", "twinform", *command.words.split()], cwd=tmp_path, check=True, capture_output=True
    )
    found = sorted(each.name for each in (tmp_path / "robot").iterdir())
    assert found == [".twinform-package", "model.config", "model.sdf"]


@pytest.mark.parametrize("there", [True, pytest.param(False, marks=pytest.mark.deep)])
def test_the_longest_name_of_a_file_system_is_no_problem(there: bool, tmp_path: Path) -> None:
    prepare(COMMANDS["a conversion"], tmp_path)
    name = f"{'x' * 251}.sdf"
    if there:
        (tmp_path / name).write_text("as it was")
    words = ["convert", "r.urdf", "-o", name, "--ledger", f"{'y' * 250}.json"]
    subprocess.run([sys.executable, "-m", "twinform", *words], cwd=tmp_path, check=True, capture_output=True)
    assert (tmp_path / name).read_text().startswith("<?xml")
    assert [each.name for each in tmp_path.iterdir() if each.name.startswith(".")] == [".git"]
