"""`format` and `fix` take folders and globs as `check` does, each the files that it can change."""

from pathlib import Path

import pytest

from tests.write_files import write_files

from .conftest import GOOD, Run

MACROS = (
    '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="m"><link name="a"/></xacro:macro></robot>'
)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return write_files(
        tmp_path,
        {
            "a.urdf": GOOD.replace("\n", "\n "),
            "robots/parts.xacro": MACROS,
            "robots/b.urdf": GOOD.replace("\n", "\n "),
            "build/c.urdf": GOOD.replace("\n", "\n "),
            "robots/data.json": "{}",
            "notes.xml": "<a><b/></a>",
        },
    )


CASES: dict[tuple[str, ...], set[str]] = {
    ("format", ".", "--check"): {"a.urdf", "robots/b.urdf", "robots/parts.xacro"},
    ("format", "robots/*", "--check"): {"robots/b.urdf", "robots/parts.xacro"},
    ("format", ".", "build/c.urdf", "--check"): {"a.urdf", "robots/b.urdf", "robots/parts.xacro", "build/c.urdf"},
    ("format", ".", "build/c.urdf", "--force-exclude", "--check"): {"a.urdf", "robots/b.urdf", "robots/parts.xacro"},
    ("format", ".", "--exclude", "robots/", "--check"): {"a.urdf"},
    ("format", "*.xml", "--check"): {"notes.xml"},
}


@pytest.mark.parametrize("words", CASES)
def test_the_files_of_folders_are_formatted(here: Path, run: Run, words: tuple[str, ...]) -> None:
    done = run(*words)
    assert (done.exit_code, set(done.stdout.split())) == (1, CASES[words]), here


def test_the_models_of_folders_are_fixed(here: Path, run: Run) -> None:
    done = run("fix", ".", "--passes", "prefix-names{prefix=x_}")
    assert done.exit_code == 0, done.output
    changed = {path.relative_to(here).as_posix() for path in here.rglob("*.urdf") if "x_" in path.read_text()}
    assert changed == {"a.urdf", "robots/b.urdf"}


@pytest.mark.parametrize("words", [("format", "none"), ("format", "*.sdf"), ("fix", "*.sdf")])
def test_nothing_to_do_is_an_error(here: Path, run: Run, words: tuple[str, ...]) -> None:
    (here / "none").mkdir()
    done = run(*words)
    assert (done.exit_code, "no model" in done.stderr) == (2, True)
