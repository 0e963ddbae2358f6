"""What a xacro file can read of the world outside: files of its folders, and variables that it is given."""

import contextlib
import glob
import os
from pathlib import Path

import pytest

from twinform.compiler.input import xacro_files
from twinform.compiler.input.xacro_files import AllowedFiles, DeniedError, variable
from twinform.file_access import Readable


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with files and links, a trusted one, and a third that is nobody's business."""
    for name in ("own/sub", "trusted", "secret"):
        (tmp_path / name).mkdir(parents=True)
    for name in ("own/a.xacro", "own/b.xacro", "own/.hidden", "own/sub/c.xacro", "trusted/file", "secret/file"):
        (tmp_path / name).write_text(name)
    (tmp_path / "trusted" / "link").symlink_to(tmp_path / "secret" / "file")
    (tmp_path / "own" / "link").symlink_to(tmp_path / "secret" / "file")
    (tmp_path / "secret" / "package.xml").write_text("<package><name>secret</name></package>")
    (tmp_path / "own" / "out").symlink_to(tmp_path / "secret")
    (tmp_path / "own" / "circle").symlink_to(tmp_path / "own" / "circle")
    os.mkfifo(tmp_path / "own" / "pipe")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _files() -> AllowedFiles:
    trusted = (Path("trusted"),)
    return AllowedFiles(Readable.of(Path("own/main.xacro"), trusted, trusted))


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
        ("own/.hidden", "hidden"),
    ],
)
@pytest.mark.usefixtures("folder")
def test_no_other_file_is_read(path: str, words: str) -> None:
    with pytest.raises(DeniedError, match=words):
        _files().read(path)


@pytest.mark.parametrize("path", ["own", "own/pipe", "own/none", "own/circle", "own/a.xacro/b", f"own/{'x' * 300}"])
@pytest.mark.usefixtures("folder")
def test_what_is_no_file_is_an_error_of_the_system(path: str) -> None:
    with pytest.raises(OSError):  # noqa: PT011 - its message is the system's
        _files().read(path)


def test_a_link_in_an_installation_leads_into_packages_only(folder: Path) -> None:
    (folder / "secret" / "package.xml").unlink()
    with pytest.raises(DeniedError, match="outside"):
        _files().read("trusted/link")


@pytest.mark.usefixtures("folder")
def test_a_large_file_is_not_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(xacro_files, "LARGEST", 3)
    with pytest.raises(DeniedError, match="larger than 3 bytes"):
        _files().read("own/a.xacro")


@pytest.mark.parametrize("path", ["own/a.xacro", "own/pipe", "own"])
@pytest.mark.usefixtures("folder")
def test_reading_leaves_no_file_open(path: str) -> None:
    before = os.listdir("/proc/self/fd")  # noqa: PTH208 - their numbers
    with contextlib.suppress(DeniedError, OSError):
        _files().read(path)
    assert os.listdir("/proc/self/fd") == before  # noqa: PTH208 - as above


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
    with pytest.raises(DeniedError, match="outside"):
        _files().match(pattern)


@pytest.mark.usefixtures("folder")
def test_a_pattern_stays_in_its_folders() -> None:
    assert "own/out/file" not in _files().match("own/*/*")
    with pytest.raises(DeniedError, match="must not go up"):
        _files().match("own/*/../../secret/*")


@pytest.mark.usefixtures("folder")
def test_a_pattern_does_not_look_through_everything(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(xacro_files, "_MOST_LOOKED_AT", 3)
    with pytest.raises(DeniedError, match="looks through more than 3 files"):
        _files().match("own/*")


@pytest.mark.parametrize("name", ["ROS_DISTRO", "GZ_SIM_RESOURCE_PATH", "AMENT_PREFIX_PATH", "JACKAL_LASER", "SIDE"])
def test_variables_of_ros_and_gazebo_and_those_that_are_given_may_be_read(name: str) -> None:
    assert variable(name, {name: "value"}, ["JACKAL_*", "SIDE"]) == "value"


def test_a_variable_that_is_not_set_is_nothing_that_could_be_denied() -> None:
    assert variable("API_KEY", {}) is None


@pytest.mark.parametrize(
    "name",
    ["API_KEY", "DBPASS", "MY_PW", "SLACK_WEBHOOK_URL", "DATABASE_URL", "ROS_BRIDGE_PW", "GZ_TOKEN", "SIDE", "HOME"],
)
def test_no_other_variable_may_be_read(name: str) -> None:
    with pytest.raises(DeniedError, match="may be a secret") as error:
        variable(name, {name: "value"}, ["JACKAL_*"])
    assert f"--env {name}" in error.value.advice
    assert "value" not in str(error.value)
