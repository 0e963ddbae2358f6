"""What may be read because a file leads to it."""

import os
from pathlib import Path

import pytest

from twinform.file_access import OutsideError, Readable

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
