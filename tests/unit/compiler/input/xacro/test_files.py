"""What a xacro file can read of the world outside: files of its folders, and variables that are no secrets."""

import contextlib
import glob
import os
from pathlib import Path

import pytest

from twinform.compiler.input.xacro import files
from twinform.compiler.input.xacro.files import Files, OutsideError
from twinform.compiler.input.xacro.variables import variable


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with files and links, a trusted one, and a third that is nobody's business."""
    for name in ("own/sub", "trusted", "secret"):
        (tmp_path / name).mkdir(parents=True)
    for name in ("own/a.xacro", "own/b.xacro", "own/.hidden", "own/sub/c.xacro", "trusted/file", "secret/file"):
        (tmp_path / name).write_text(name)
    (tmp_path / "trusted" / "link").symlink_to(tmp_path / "secret" / "file")
    (tmp_path / "own" / "link").symlink_to(tmp_path / "secret" / "file")
    (tmp_path / "own" / "out").symlink_to(tmp_path / "secret")
    (tmp_path / "own" / "circle").symlink_to(tmp_path / "own" / "circle")
    os.mkfifo(tmp_path / "own" / "pipe")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _files() -> Files:
    return Files.of(["secret/../single"], ["own"], ["trusted"])


@pytest.mark.parametrize("path", ["own/a.xacro", "own/sub/../a.xacro", "trusted/file", "trusted/link"])
def test_files_of_its_folders_may_be_read(path: str, folder: Path) -> None:
    assert _files().read(path) == _files().read(str(folder / path)) == (folder / path).read_bytes()


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("secret/file", "outside"),
        ("own/../secret/file", "outside"),
        ("own/link", "outside"),
        ("own/out/file", "outside"),
        ("owner", "outside"),
        ("/etc/passwd", "outside"),
        ("/etc/none", "outside"),
        ("own", "no file"),
        ("own/pipe", "no file"),
    ],
)
@pytest.mark.usefixtures("folder")
def test_no_other_file_is_read(path: str, words: str) -> None:
    with pytest.raises(OutsideError, match=words):
        _files().read(path)


@pytest.mark.parametrize("path", ["own/none", "own/circle", "own/a.xacro/b", f"own/{'x' * 300}"])
@pytest.mark.usefixtures("folder")
def test_what_is_not_there_is_an_error_of_the_system(path: str) -> None:
    with pytest.raises(OSError):  # noqa: PT011 - its message is the system's
        _files().read(path)


def test_one_file_may_be_named_alone(folder: Path) -> None:
    (folder / "single").write_text("s")
    assert _files().read("single") == b"s"


@pytest.mark.usefixtures("folder")
def test_a_large_file_is_not_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "LARGEST", 3)
    with pytest.raises(OutsideError, match="larger than 3 bytes"):
        _files().read("own/a.xacro")


@pytest.mark.parametrize("path", ["own/a.xacro", "own/pipe", "own"])
@pytest.mark.usefixtures("folder")
def test_reading_leaves_no_file_open(path: str, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: list[int] = []
    by_system = os.open

    def note(path: str, flags: int) -> int:
        opened.append(by_system(path, flags))
        return opened[-1]

    monkeypatch.setattr(os, "open", note)
    with contextlib.suppress(OutsideError):
        _files().read(path)
    (descriptor,) = opened
    with pytest.raises(OSError, match="Bad file descriptor"):
        os.fstat(descriptor)


@pytest.mark.parametrize(
    "pattern",
    ["own/*", "own/*.xacro", "own/?.xacro", "own/[ab].xacro", "own/.*", "own/*/c.xacro", "own/s*/*", "own/none*",
     "own/*/none", "./own/*.xacro", "own/**/c.xacro", "own/[", "own//*.xacro"],
)  # fmt: skip
@pytest.mark.usefixtures("folder")
def test_a_pattern_matches_what_the_shell_matches(pattern: str) -> None:
    outside = ("own/out/",)
    by_python = sorted(glob.glob(pattern))  # noqa: PTH207 - it is what xacro uses
    assert _files().match(pattern) == [each for each in by_python if not each.startswith(outside)]


@pytest.mark.parametrize("pattern", ["secret/*", "own/../secret/*", "/*", "/etc/*", "own/out/*", "*", "../*"])
@pytest.mark.usefixtures("folder")
def test_a_pattern_starts_in_its_folders(pattern: str) -> None:
    with pytest.raises(OutsideError, match="outside"):
        _files().match(pattern)


@pytest.mark.usefixtures("folder")
def test_a_pattern_stays_in_its_folders() -> None:
    assert "own/out/file" not in _files().match("own/*/*")
    with pytest.raises(OutsideError, match="must not go up"):
        _files().match("own/*/../../secret/*")


@pytest.mark.usefixtures("folder")
def test_a_pattern_does_not_look_through_everything(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(files, "_MOST_LOOKED_AT", 3)
    with pytest.raises(OutsideError, match="looks through more than 3 files"):
        _files().match("own/*")


@pytest.mark.parametrize(
    "name", ["JACKAL_LASER", "HOME", "PWD", "ROBOT_NAMESPACE", "KEYBOARD", "TURTLEBOT3_MODEL", "NO"]
)
def test_variables_of_robots_may_be_read(name: str) -> None:
    assert variable(name, {} if name == "NO" else {name: "value"}) == (None if name == "NO" else "value")


@pytest.mark.parametrize(
    "name",
    [
        "API_KEY",
        "GITHUB_TOKEN",
        "AWS_SECRET_ACCESS_KEY",
        "PGPASSWORD",
        "MYSQL_PWD",
        "SSH_AUTH_SOCK",
        "SECRETS",
        "my-key",
    ],
)
def test_secrets_may_not_be_read_be_they_set_or_not(name: str) -> None:
    for environment in ({name: "value"}, {}):
        with pytest.raises(OutsideError, match="may be a secret") as error:
            variable(name, environment)
        assert "$(arg" in error.value.advice


def test_a_password_in_an_address_may_not_be_read() -> None:
    with pytest.raises(OutsideError, match="may be a secret"):
        variable("DATABASE", {"DATABASE": "postgres://me:it@host/base"})
    assert variable("MASTER", {"MASTER": "http://localhost:11311/"}) == "http://localhost:11311/"
