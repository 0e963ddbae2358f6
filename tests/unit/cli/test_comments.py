"""Comments in what the command line writes."""

from pathlib import Path

import pytest

from .conftest import Run

COMMENTED = '<!-- license -->\n<robot name="r">\n  <!-- the base -->\n  <link name="a"/> <!-- a -->\n</robot>\n'


@pytest.fixture
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A commented file, alone in the current folder."""
    monkeypatch.chdir(tmp_path)
    Path("robots").mkdir()
    path = Path("robots/r.urdf")
    path.write_text(COMMENTED)
    return path


@pytest.mark.parametrize("target", ["sdf", "urdf"])
def test_convert_takes_comments_along(run: Run, robot: Path, target: str) -> None:
    made = run("convert", robot, "--to", target).stdout
    assert made.count("<!--") == 3
    assert made.splitlines()[1] == "<!-- license -->"
    without = run("convert", robot, "--to", target, "--no-comments").stdout
    assert "<!--" not in without


def test_json_has_none(run: Run, robot: Path) -> None:
    assert "license" not in run("convert", robot, "--to", "json").stdout


@pytest.mark.slow
def test_batch_writes_the_same_bytes(run: Run, robot: Path) -> None:
    assert run("batch", "convert", "robots", "made", "--to", "sdf").exit_code == 0
    assert run("convert", robot, "-o", "alone.sdf").exit_code == 0
    assert Path("made/r.sdf").read_bytes() == Path("alone.sdf").read_bytes()
    assert run("batch", "convert", "robots", "made", "--to", "sdf", "--no-comments").exit_code == 0
    assert "<!--" not in Path("made/r.sdf").read_text()


def test_the_audit_does_not_count_them(run: Run, robot: Path) -> None:
    assert run("convert", robot, "-o", "alone.sdf", "--audit").exit_code == 0


def test_a_change_in_its_place_leaves_them(run: Run, robot: Path) -> None:
    assert run("convert", robot, "--in-place", "--passes", "rename{names=[a:b]}").exit_code == 0
    assert robot.read_text() == COMMENTED.replace('"a"', '"b"')


def test_into_leaves_those_of_the_other_file(run: Run, robot: Path) -> None:
    assert run("convert", robot, "-o", "r.sdf").exit_code == 0
    text = Path("r.sdf").read_text()
    Path("r.sdf").write_text(text.replace("<!-- the base -->", "<!-- the floor -->"))
    assert run("convert", "r.sdf", "--into", robot).exit_code == 0
    assert robot.read_text() == COMMENTED
