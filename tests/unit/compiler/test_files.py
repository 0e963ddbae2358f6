"""Output is all there or not there at all."""

import os
from pathlib import Path

import pytest
from click.testing import CliRunner

from twinform.cli import main
from twinform.compiler import write_atomically

_GOOD = '<robot name="r"><link name="a"/></robot>'
_BAD = '<robot name="r"><link name="a"/><link name="a"/></robot>'


def _names(folder: Path) -> list[str]:
    return sorted(file.name for file in folder.iterdir())


def test_a_bad_file_leaves_the_output_untouched(tmp_path: Path) -> None:
    source, out = tmp_path / "bad.urdf", tmp_path / "out.sdf"
    source.write_text(_BAD)
    out.write_text("as it was")
    result = CliRunner().invoke(main, ["convert", str(source), "-o", str(out)])
    assert result.exit_code == 1
    assert out.read_text() == "as it was"
    assert _names(tmp_path) == ["bad.urdf", "out.sdf"]


def test_output_may_be_the_input(tmp_path: Path) -> None:
    file = tmp_path / "robot.urdf"
    file.write_text(_GOOD)
    result = CliRunner().invoke(main, ["convert", str(file), "--to", "urdf", "-o", str(file)])
    assert result.exit_code == 0
    assert '<link name="a"/>' in file.read_text()


@pytest.mark.parametrize("call", ["fsync", "fdopen"])
def test_a_failure_while_writing_leaves_the_old_file_and_no_other(
    call: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "robot.sdf"
    file.write_text("old")

    def fail(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, call, fail)
    with pytest.raises(OSError, match="No space"):
        write_atomically(file, "new")
    assert file.read_text() == "old"
    assert _names(tmp_path) == ["robot.sdf"]


def test_an_interrupt_while_writing_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "robot.sdf"
    file.write_text("old")

    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_atomically(file, "new")
    assert _names(tmp_path) == ["robot.sdf"]


def test_permissions_stay_and_links_are_followed(tmp_path: Path) -> None:
    file, link = tmp_path / "real.sdf", tmp_path / "link.sdf"
    file.write_text("old")
    file.chmod(0o640)
    link.symlink_to(file)
    write_atomically(link, "new")
    assert file.read_text() == "new"
    assert file.stat().st_mode & 0o777 == 0o640
    assert link.is_symlink()


def test_a_missing_folder_is_made(tmp_path: Path) -> None:
    file = tmp_path / "models" / "arm" / "robot.sdf"
    write_atomically(file, "new")
    assert file.read_text() == "new"


def test_a_file_in_the_way_of_a_folder_is_an_error_that_names_what_is_written(tmp_path: Path) -> None:
    (tmp_path / "models").write_text("a file")
    with pytest.raises(OSError, match=r"a file stands where its folder would be.*robot\.sdf"):
        write_atomically(tmp_path / "models" / "robot.sdf", "new")
