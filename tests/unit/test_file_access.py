"""What may be read because a file leads to it."""

import os
from pathlib import Path

import pytest

from twinform.file_access import OutsideError, Readable, find_root, folders_around, itself, neighborhood

TEXT = b"text"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A package with links, and what lies around it."""
    for name in ("p/package.xml", "p/a", "p/.hidden", "p/.git_/b", "p/sub/c", "q/package.xml", "q/d", "r/e", "f"):
        path = tmp_path / "ws" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(TEXT)
    for name, target in {"in": "sub/c", "out": "../f", "hid": ".hidden", "up": "..", "mine": "../q/d"}.items():
        (tmp_path / "ws/p" / name).symlink_to(target)
    os.mkfifo(tmp_path / "ws/p/pipe")
    return tmp_path / "ws"


@pytest.mark.parametrize("path", ["p/a", "p/sub/c", "p/in", "p/sub/../a", "p/mine", "q/d", "p/up/p/a"])
def test_what_lies_below_the_root_and_in_packages_beside_it_may_be_read(path: str, folder: Path) -> None:
    assert Readable.of(folder / "p/r.urdf").read(folder / path) == TEXT


@pytest.mark.parametrize(
    ("path", "why"),
    [
        ("f", "outside"),
        ("r/e", "outside"),
        ("p/out", "outside"),
        ("p/up/f", "outside"),
        ("p/../f", "outside"),
        ("p/.hidden", "hidden"),
        ("p/hid", "hidden"),
        ("p/.git_/b", "hidden"),
        ("/etc/passwd", "outside"),
    ],
)
def test_nothing_else_may_be_read(path: str, why: str, folder: Path) -> None:
    with pytest.raises(OutsideError, match=why):
        Readable.of(folder / "p/r.urdf").read(folder / path)


def test_a_hidden_file_that_is_named_is_read_and_so_are_its_neighbors(folder: Path) -> None:
    assert Readable.of(folder / "p/.hidden").read(folder / "p/.hidden") == TEXT
    (folder / "p/.git_/n").write_bytes(TEXT)
    assert Readable.of(folder / "p/.git_/b").read(folder / "p/.git_/n") == TEXT


def test_a_pipe_is_not_opened(folder: Path) -> None:
    with pytest.raises(OSError, match="it is a pipe and no file"):
        Readable.of(folder / "p/r.urdf").read(folder / "p/pipe")


def test_a_file_that_is_exchanged_for_a_link_after_the_look_is_not_read(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    by_system = os.open

    def exchange(path: str, flags: int) -> int:
        (folder / "p/a").unlink()
        (folder / "p/a").symlink_to(folder / "f")
        return by_system(path, flags)

    monkeypatch.setattr(os, "open", exchange)
    with pytest.raises(OutsideError):
        Readable.of(folder / "p/r.urdf").read(folder / "p/a")


FILE = "home/ws/src/a/urdf/parts/r.urdf"
MARKS: dict[str, tuple[list[str], str]] = {
    "nothing": ([], "home/ws/src/a/urdf/parts"),
    "a package": (["home/ws/src/a/package.xml"], "home/ws/src/a"),
    "a package in a package": (["home/ws/src/a/package.xml", "home/ws/package.xml"], "home/ws/src/a"),
    "a model in a package": (["home/ws/src/a/urdf/model.config", "home/ws/src/a/package.xml"], "home/ws/src/a"),
    "a project in a package": (["home/ws/src/a/urdf/twinform.toml", "home/ws/src/a/package.xml"], "home/ws/src/a"),
    "a project of packages": (["home/ws/twinform.toml", "home/ws/src/a/package.xml"], "home/ws"),
    "a repository": (["home/ws/.git/HEAD", "home/ws/src/a/package.xml"], "home/ws"),
    "a repository in a package": (["home/ws/src/a/urdf/.hg/x", "home/ws/src/a/package.xml"], "home/ws/src/a/urdf"),
    "a repository of settings": (["home/.git/HEAD"], "home/ws/src/a/urdf/parts"),
    "a package above the home folder": (["package.xml"], "home/ws/src/a/urdf/parts"),
}  # fmt: skip


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    _put(tmp_path / FILE)
    return tmp_path


def _put(path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.touch()


@pytest.mark.parametrize("name", MARKS)
def test_the_root_of_a_file_is_the_highest_of_the_nearest_marks(name: str, tree: Path) -> None:
    marks, root = MARKS[name]
    for mark in marks:
        _put(tree / mark)
    assert find_root(tree / FILE) == tree / root


def test_a_folder_that_everybody_writes_to_is_no_root(tree: Path) -> None:
    _put(tree / "home/ws/package.xml")
    (tree / "home/ws").chmod(0o1777)
    assert find_root(tree / FILE) == tree / "home/ws/src/a/urdf/parts"


def test_the_folder_that_the_environment_names_is_the_highest_root(tree: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _put(tree / "home/ws/.git/HEAD")
    monkeypatch.setenv("TWINFORM_ROOT", str(tree / "home/ws/src/a"))
    assert find_root(tree / FILE) == tree / "home/ws/src/a"
    assert find_root(tree / "home/ws/other.urdf") == tree / "home/ws"  # it says nothing about what lies outside of it
    assert neighborhood(tree / "home/ws/src/a") is None
    _put(tree / "home/ws/src/a/urdf/.git/HEAD")
    assert find_root(tree / FILE) == tree / "home/ws/src/a/urdf"
    monkeypatch.setenv("TWINFORM_ROOT", str(tree / "home"))
    assert find_root(tree / "home/alone/r.urdf") == tree / "home/alone"  # a home folder is no root


@pytest.mark.parametrize("target", ["home", "tmp"])
def test_a_link_to_a_folder_that_is_no_root_ends_nothing(target: str, tree: Path) -> None:
    (tree / "tmp").mkdir()
    (tree / "tmp").chmod(0o1777)
    _put(tree / "home/ws/.git/HEAD")
    (tree / "home/ws/up").symlink_to(tree / target)
    assert find_root(tree / "home/ws/up/secret.urdf") == tree / "home/ws"


def test_folders_have_the_names_that_were_given(tree: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _put(tree / "home/ws/.git/HEAD")
    monkeypatch.chdir(tree / "home/ws/src/a")
    assert folders_around(Path("urdf/r.urdf")) == (Path("urdf"), Path(), tree / "home/ws/src", tree / "home/ws")


def test_packages_lie_beside_a_package_that_is_in_no_repository(tree: Path) -> None:
    assert neighborhood(find_root(tree / FILE)) is None
    _put(tree / "home/ws/src/a/package.xml")
    assert neighborhood(find_root(tree / FILE)) == tree / "home/ws/src"
    _put(tree / "home/ws/src/a/.git/HEAD")
    assert neighborhood(find_root(tree / FILE)) is None
    _put(tree / "home/b/package.xml")
    assert neighborhood(find_root(tree / "home/b/r.urdf")) is None  # the home folder is no workspace


def test_a_file_by_a_name_without_links_needs_no_surroundings(folder: Path) -> None:
    for name in ("a", ".hidden", ".git_/b"):
        alone = itself(folder / "p" / name)
        assert alone is not None
        assert alone.read(folder / "p" / name) == TEXT
        assert not alone.allows(folder / "p/sub/c")
    (folder / "linked").symlink_to("p")
    assert [itself(folder / each) for each in ("p/in", "p/out", "p/hid", "linked/a", "p/up/f", "nul\0")] == [None] * 6
