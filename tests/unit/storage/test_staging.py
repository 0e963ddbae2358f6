"""Staging folders, and what killed processes have left of them."""

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from twinform.storage import staging
from twinform.storage.staging import PREFIX, remove_leftovers, staging_folder

_KILLED = """
import os, signal, sys
from pathlib import Path
from twinform.storage.staging import staging_folder
with staging_folder(Path(sys.argv[1])) as folder:
    (folder / "half").write_text("half")
    (folder / "link").symlink_to(sys.argv[1])
    os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.fixture(autouse=True)
def _searched_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(staging, "_searched", set[Path]())


def _killed_in(folder: Path) -> Path:
    """What a process leaves that is killed while it writes."""
    done = subprocess.run([sys.executable, "-c", _KILLED, str(folder)], check=False)
    assert done.returncode == -signal.SIGKILL
    (left,) = folder.glob(f"{PREFIX}*")
    return left


def test_a_folder_goes_with_all_that_is_in_it(tmp_path: Path) -> None:
    with staging_folder(tmp_path) as folder:
        (folder / "inner").mkdir()
        (folder / "inner/file").write_text("text")
    assert not [*tmp_path.iterdir()]


def test_what_a_killed_process_has_left_goes_and_links_in_it_are_not_followed(tmp_path: Path) -> None:
    (tmp_path / "mine").write_text("mine")
    _killed_in(tmp_path)
    remove_leftovers(tmp_path)
    assert [each.name for each in tmp_path.iterdir()] == ["mine"]


def test_a_folder_in_use_stays(tmp_path: Path) -> None:
    with staging_folder(tmp_path) as folder:
        (folder / "file").write_text("text")
        remove_leftovers(tmp_path)
        code = "import sys; from pathlib import Path; from twinform.storage.staging import remove_leftovers as r"
        subprocess.run([sys.executable, "-c", f"{code}; r(Path(sys.argv[1]))", str(tmp_path)], check=True)
        assert (folder / "file").read_text() == "text"


def test_what_only_looks_like_a_staging_folder_stays(tmp_path: Path) -> None:
    left = _killed_in(tmp_path)
    shutil.copytree(left, tmp_path / f"{PREFIX}copy", symlinks=True)
    (tmp_path / f"{PREFIX}file").write_text("mine")
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere/file").write_text("mine")
    (tmp_path / f"{PREFIX}link").symlink_to("elsewhere")
    (tmp_path / f"{PREFIX}full").mkdir()
    (tmp_path / f"{PREFIX}full/file").write_text("mine")
    os.mkfifo(tmp_path / f"{PREFIX}pipe")
    there = {path: path.lstat().st_ino for path in tmp_path.rglob("*") if not path.is_relative_to(left)}
    remove_leftovers(tmp_path)
    assert {path: path.lstat().st_ino for path in tmp_path.rglob("*")} == there


def test_what_somebody_else_has_added_keeps_a_folder_there(tmp_path: Path) -> None:
    left = _killed_in(tmp_path)
    (left / "notes").write_text("mine")
    remove_leftovers(tmp_path)
    assert (left / "notes").read_text() == "mine"


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a folder away")
def test_a_folder_of_another_user_stays(tmp_path: Path) -> None:
    left = _killed_in(tmp_path)
    os.chown(left, 1234, 1234)
    remove_leftovers(tmp_path)
    assert left.exists()


@pytest.mark.parametrize("error", [KeyboardInterrupt, SystemExit])
def test_an_interrupt_of_the_cleanup_is_raised_when_all_is_gone(
    error: type[BaseException], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = os.rmdir
    raised = iter([error()])

    def rmdir(*args: Any, **more: Any) -> None:
        if now := next(raised, None):
            raise now
        real(*args, **more)

    monkeypatch.setattr(os, "rmdir", rmdir)
    with pytest.raises(error), staging_folder(tmp_path) as folder:
        (folder / "inner").mkdir()
    assert not [*tmp_path.iterdir()]
