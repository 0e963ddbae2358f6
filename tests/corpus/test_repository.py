"""A public repository with a configuration, a baseline and suppressions: green, and red when a file breaks."""

import json
from pathlib import Path

import pytest

from tests.corpus.repository import HOUSE, WORLD, build, hook, run

GENERATED = ["robots/arm.urdf.xacro", "-o", "robots/arm.sdf"]


@pytest.fixture(scope="module")
def repository(corpus: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("repository")
    build(corpus, folder)
    begun = run(folder, *hook("twinform-check"), "--update-baseline")
    assert (begun.exit_code, begun.stdout) == (0, "")
    assert run(folder, "convert", *GENERATED).exit_code == 0
    return folder


def _check(folder: Path) -> tuple[int, str, str]:
    done = run(folder, *hook("twinform-check"))
    return done.exit_code, done.stdout, done.stderr


def test_it_is_green(repository: Path) -> None:
    code, out, summary = _check(repository)
    assert (code, out) == (0, "")
    assert "could not be read" not in summary
    assert "3 allowed; " in summary
    known = json.loads((repository / "known/twinform.json").read_text())["findings"]
    assert {row["rule"] for row in known} == {"missing-file"}
    assert all(row["file"].startswith("../turtlebot3/") for row in known)
    assert run(repository, *hook("twinform-generated"), *GENERATED).exit_code == 0
    assert "left_tool" in (repository / "robots/arm.sdf").read_text()


def test_lines_may_move(repository: Path) -> None:
    file = repository / WORLD
    before = file.read_text()
    file.write_text(before.replace("<world", "\n\n\n<world", 1))
    assert _check(repository)[:2] == (0, "")
    file.write_text(before)


@pytest.mark.parametrize(
    ("name", "old", "new", "code", "words"),
    [
        (str(HOUSE), "</world>", "", 1, "[not-well-formed]"),
        (str(WORLD), "twinform: allow indefinite-inertia", "allow indefinite-inertia", 1, "[indefinite-inertia]"),
        ("robots/parts.xacro", 'link="${side}_tool"', 'link="${side}_tol"', 1, "robots/parts.xacro:7:20: error: "),
        ("robots/arm.urdf.xacro", '<link name="base"/>', '<link name="base" mass="1"/>', 1, "[unknown-attribute]"),
        ("twinform.toml", "strict = true", "strict = 1", 2, "twinform.toml: files[0].strict: "),
    ],
)
def test_it_is_red_when_a_file_breaks(repository: Path, name: str, old: str, new: str, code: int, words: str) -> None:
    file = repository / name
    before = file.read_text()
    assert old in before
    file.write_text(before.replace(old, new, 1))
    try:
        found, out, err = _check(repository)
        assert (found, words in out + err) == (code, True), out + err
    finally:
        file.write_text(before)


def test_a_file_that_is_out_of_date_is_red(repository: Path) -> None:
    parts = repository / "robots/parts.xacro"
    before = parts.read_text()
    parts.write_text(before.replace("_tool", "_hand"))
    done = run(repository, *hook("twinform-generated"), *GENERATED)
    assert done.exit_code == 1
    assert 'name="left_tool"' in done.stdout
    assert 'name="left_hand"' in done.stdout
    assert "robots/arm.sdf is not what it is made to be" in done.stderr
    parts.write_text(before)
