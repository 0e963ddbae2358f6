"""`twinform view`: what ends it before it shows anything. How it shows robots is tested in a browser."""

import socket
import sys
from pathlib import Path

import pytest

from twinform.installation import install_command

from .conftest import Run


@pytest.mark.parametrize("name", ["broken.urdf", "nothing.urdf"])
def test_what_cannot_be_read_ends_it(run: Run, folder: Path, name: str):
    done = run("view", folder / name, "--no-open")
    assert done.exit_code == 2
    assert name in done.stderr
    assert "error" in done.stderr


def test_one_of_two_that_cannot_be_read_ends_it(run: Run, folder: Path):
    assert run("view", folder / "good.urdf", folder / "nothing.urdf", "--no-open").exit_code == 2


def test_it_shows_two_files_at_most(run: Run, folder: Path):
    done = run("view", *[folder / "good.urdf"] * 3)
    assert (done.exit_code, "view shows one file or two" in done.stderr) == (2, True)


def test_standard_input_is_never_saved_again(run: Run):
    done = run("view", "-", "--watch", text="<robot name='r'><link name='l'/></robot>")
    assert (done.exit_code, "--watch shows files" in done.stderr) == (2, True)


def test_a_port_that_is_taken_is_an_error(run: Run, folder: Path):
    pytest.importorskip("viser", reason="viser is not installed")
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        done = run("view", folder / "good.urdf", "--no-open", "--port", str(port))
    assert done.exit_code == 2
    assert str(port) in done.stderr


def test_without_what_it_is_drawn_with_it_says_what_to_install(run: Run, folder: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "viser", None)
    done = run("view", folder / "good.urdf", "--no-open")
    assert done.exit_code == 2
    assert f"run: {install_command('view')}" in done.stderr
