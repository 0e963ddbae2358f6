"""What work depends on, as it is observed, and whether it still is so."""

import os
import time
from pathlib import Path

import pytest

from twinform.compiler.dependencies import (
    Dependency,
    DependencyKind,
    are_current,
    are_same,
    dependencies_of,
    packed,
    renewed,
    unpacked,
)
from twinform.compiler.observing import Observation, observed


def _old(path: Path, text: str = "x") -> Path:
    path.write_text(text)
    os.utime(path, (1_000_000_000, 1_000_000_000))
    return path


def _observed_in(seen: Observation, root: Path) -> dict[str, Dependency]:
    found = dependencies_of(seen, str(root), outside=str(root / "out"))
    assert found is not None
    return {dependency.path: dependency for dependency in found}


def test_all_that_is_asked_for_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("opened", "read", "looked", "out"):
        if name != "out":
            _old(tmp_path / name)
    (tmp_path / "folder").mkdir()
    (tmp_path / "out").mkdir()
    _old(tmp_path / "folder/inside")
    _old(tmp_path / "out/result")
    with observed() as seen:
        Path("opened").open().close()
        (tmp_path / "read").read_bytes()
        (tmp_path / "out/result").read_bytes()
        assert (tmp_path / "looked").is_file()
        assert not Path("absent").exists()
        os.listdir("folder")  # noqa: PTH208 - as passes of others do
        list(os.walk("folder"))
        (tmp_path / "written").write_text("no input")
    dependencies = _observed_in(seen, tmp_path)
    assert {path: dependency.kind for path, dependency in dependencies.items()} == {
        "opened": DependencyKind.READ,
        "read": DependencyKind.READ,
        "looked": DependencyKind.FILE,
        "absent": DependencyKind.ABSENT,
        "folder": DependencyKind.LISTED,
    }
    assert tuple(unpacked(packed(dependencies.values()))) == tuple(dependencies.values())
    now = time.time_ns() + 1_000_000_000
    root = str(tmp_path)
    files = [dependency for dependency in dependencies.values() if dependency.kind is not DependencyKind.LISTED]
    assert are_current(files, root, noted=now)
    assert not are_current(dependencies.values(), root, noted=now)  # the folder is young
    assert are_same(dependencies.values(), root)
    assert not are_same(dependencies.values(), str(tmp_path / "folder"))


def test_nothing_is_seen_outside_or_in_other_threads(tmp_path: Path) -> None:
    path = _old(tmp_path / "a")
    with observed() as one:
        pass
    path.read_bytes()
    with observed() as two:
        path.read_bytes()
    assert (one.read, list(two.read)) == ({}, [str(path)])


def test_what_changes_while_it_is_read_says_nothing(tmp_path: Path) -> None:
    path = _old(tmp_path / "a", "old")
    with observed() as seen:
        path.read_bytes()
        _old(path, "newer")
    assert dependencies_of(seen, str(tmp_path), outside=None) is None


def test_what_changes_while_it_is_read_and_leaves_no_trace_in_its_time_says_nothing(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_text("old")
    status = path.stat()
    with observed() as seen:
        path.read_bytes()
        path.write_text("new")
        os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert dependencies_of(seen, str(tmp_path), outside=None) is None


def test_a_link_that_leads_elsewhere_is_another_file(tmp_path: Path) -> None:
    _old(tmp_path / "a", "one")
    _old(tmp_path / "b", "two")
    link = tmp_path / "link"
    link.symlink_to("a")
    with observed() as seen:
        link.read_bytes()
    dependencies = _observed_in(seen, tmp_path).values()
    assert are_same(dependencies, str(tmp_path))
    link.unlink()
    link.symlink_to("b")
    assert not are_same(dependencies, str(tmp_path))


def _current(path: Path, dependency: Dependency) -> bool:
    return are_current([dependency], str(path.parent), noted=time.time_ns() + 10_000_000_000)


def _written(path: Path, text: str) -> Dependency:
    with observed() as seen:
        _old(path, text).read_bytes()
    return _observed_in(seen, path.parent)[path.name]


def test_another_content_of_one_size_and_time_is_seen(tmp_path: Path) -> None:
    """As `rsync -t`, Nix, Bazel and reproducible archives leave them."""
    path = tmp_path / "a"
    dependency = _written(path, "one")
    assert _current(path, dependency)
    _old(path, "two")
    assert not _current(path, dependency)
    assert not are_same([dependency], str(tmp_path))
    _old(tmp_path / "b", "two").replace(path)
    assert not _current(path, dependency)


def test_a_time_of_the_last_change_that_somebody_made_up_proves_nothing(tmp_path: Path) -> None:
    """Images of squashfs and mounts by FUSE have the time of the last modification there, in whole seconds."""
    path = tmp_path / "a"
    status = os.stat_result((0o100644, 7, 1, 1, 0, 0, 3, 9, 9, 9), {"st_mtime_ns": 10**18, "st_ctime_ns": 10**18})
    dependency = Dependency("a", DependencyKind.READ, 3, 10**18, "x", 10**18, 7)
    assert not are_current([dependency], str(path.parent), status=lambda _: status)


def test_what_is_only_newer_has_its_new_status(tmp_path: Path) -> None:
    path = tmp_path / "a"
    dependency = _written(path, "one")
    path.write_text("one")
    found = renewed([dependency], str(tmp_path))
    assert found is not None
    assert not _current(path, dependency)
    assert _current(path, found[0])
    path.write_text("two")
    assert renewed([dependency], str(tmp_path)) is None


@pytest.mark.parametrize("row", [[], ["a"], ["a", "eaten"], [1, "read"], ["a", "read", "1"], ["a", "read", 1, 2, 3]])
def test_what_is_no_need_is_refused(row: list[object]) -> None:
    with pytest.raises((ValueError, TypeError)):
        list(unpacked([row]))
