"""The root of a file: the top of its repository, or of what has a mark around it."""

from pathlib import Path

import pytest

from twinform.file_access.roots import find_root, folders_around, neighborhood

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
