"""Output is all there or not there at all."""

import os
import shutil
from contextlib import suppress
from itertools import count
from pathlib import Path

import pytest
from click.testing import CliRunner

from tests.hostile.injected import CALLS, Counter
from twinform.cli import main
from twinform.compiler import write_all_atomically, write_atomically
from twinform.storage.writing import write_new_file

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


@pytest.mark.parametrize("call", ["fsync", "mkdir", "replace"])
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


def _three(folder: Path) -> dict[Path, str]:
    """Texts for a file that is there, one in a new folder, and one more that is there."""
    (folder / "a.sdf").write_text("old a")
    (folder / "c.sdf").write_text("old c")
    (folder / "c.sdf").chmod(0o640)
    return {folder / "a.sdf": "a", folder / "new/b.sdf": "b", folder / "c.sdf": "c"}


def _is_as_it_was(folder: Path) -> bool:
    texts = [(folder / name).read_text() for name in ("a.sdf", "c.sdf")]
    return texts == ["old a", "old c"] and _names(folder) == ["a.sdf", "c.sdf"]


def test_several_files_are_written_together(tmp_path: Path) -> None:
    texts = _three(tmp_path)
    write_all_atomically(texts)
    assert {path: path.read_text() for path in texts} == texts
    assert (tmp_path / "c.sdf").stat().st_mode & 0o777 == 0o640
    assert _names(tmp_path) == ["a.sdf", "c.sdf", "new"]
    assert _names(tmp_path / "new") == ["b.sdf"]


@pytest.mark.parametrize(
    "fault", [OSError(28, "No space left on device"), KeyboardInterrupt()], ids=["full", "stopped"]
)
@pytest.mark.parametrize("links", [True, False], ids=["links", "no links"])
@pytest.mark.parametrize("last", ["a.sdf", "b.sdf", "c.sdf"])
def test_a_move_that_fails_takes_the_others_back(
    last: str, links: bool, fault: BaseException, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    texts, real, moved = _three(tmp_path), Path.replace, list[str]()

    def replace(path: Path, target: Path) -> Path:
        if target.name == last and last not in moved:  # what is put back comes by here too
            moved.append(last)
            raise fault
        return real(path, target)

    def no_link(*_: object) -> None:
        raise OSError(1, "Operation not permitted")

    monkeypatch.setattr(Path, "replace", replace)
    if not links:
        monkeypatch.setattr(os, "link", no_link)
    with pytest.raises(type(fault)):
        write_all_atomically(texts)
    assert moved == [last]
    assert _is_as_it_was(tmp_path)


def test_what_fails_before_the_moves_leaves_nothing(tmp_path: Path) -> None:
    def fail() -> None:
        assert _names(tmp_path / "new") != []  # all is written by now
        raise OSError(28, "No space left on device")

    with pytest.raises(OSError, match="No space"):
        write_all_atomically(_three(tmp_path), fail)
    assert _is_as_it_was(tmp_path)


def test_a_link_that_leads_to_itself_is_an_error_with_a_message(tmp_path: Path) -> None:
    link = tmp_path / "round.sdf"
    link.symlink_to(link)
    with pytest.raises(OSError, match=r"a symbolic link that leads to itself.*round\.sdf"):
        write_atomically(link, "new")
    assert link.is_symlink()


def test_a_path_may_be_a_text(tmp_path: Path) -> None:
    write_atomically(str(tmp_path / "new/robot.urdf"), "<robot/>")
    assert (tmp_path / "new/robot.urdf").read_text() == "<robot/>"


def test_extended_attributes_stay(tmp_path: Path) -> None:
    file = tmp_path / "robot.sdf"
    file.write_text("old")
    try:
        os.setxattr(file, "user.origin", b"here")
    except (AttributeError, OSError):
        pytest.skip("there are none")
    write_atomically(file, "new")
    assert os.getxattr(file, "user.origin") == b"here"


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give a file away")
def test_what_root_writes_over_stays_its_owners(tmp_path: Path) -> None:
    file = tmp_path / "robot.sdf"
    file.write_text("old")
    os.chown(file, 1234, 1235)
    write_atomically(file, "new")
    assert (file.read_text(), file.stat().st_uid, file.stat().st_gid) == ("new", 1234, 1235)


def test_a_new_file_is_written_over_nothing(tmp_path: Path) -> None:
    write_new_file(tmp_path / "new/a.json", "one")
    with pytest.raises(FileExistsError):
        write_new_file(tmp_path / "new/a.json", "two")
    assert (tmp_path / "new/a.json").read_text() == "one"
    assert _names(tmp_path / "new") == ["a.json"]


def test_many_files_are_written_together(tmp_path: Path) -> None:
    texts = {tmp_path / f"{number}.sdf": str(number) for number in range(100)}
    write_all_atomically(texts)
    assert {path: path.read_text() for path in tmp_path.iterdir()} == texts


def test_an_interrupt_at_any_call_is_raised_and_leaves_all_old_or_all_new(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one, two = tmp_path / "one", tmp_path / "new/two"
    for number in count(1):
        shutil.rmtree(two.parent, ignore_errors=True)
        one.write_text("old")
        counter = Counter("KeyboardInterrupt", number)
        with monkeypatch.context() as patch, suppress(KeyboardInterrupt):
            for name in CALLS:
                patch.setattr(os, name, counter.around(getattr(os, name)))
            write_all_atomically({one: "new", two: "new"})
            assert counter.count < number
        found = {path.name: path.is_file() and path.read_text() for path in tmp_path.rglob("*")}
        assert found in ({"one": "old"}, {"one": "new", "new": False, "two": "new"})
        if counter.count < number:
            return
