"""Files that passes make of meshes, by each command that writes results."""

import importlib
from pathlib import Path
from typing import Any

import pytest

from .conftest import Run

trimesh: Any = importlib.import_module("trimesh")
PASSES = "convert-meshes{to=obj}"
ROBOT = """<robot name="r"><!-- kept --><link name="base">
<collision name="c"><geometry><mesh filename="meshes/ball.stl"/></geometry></collision></link></robot>"""


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    (tmp_path / "meshes").mkdir()
    trimesh.creation.icosphere(1, 0.5).export(tmp_path / "meshes" / "ball.stl")
    (tmp_path / "r.urdf").write_text(ROBOT)
    return tmp_path / "r.urdf"


def test_convert_writes_them_below_the_folder_of_the_result(run: Run, robot: Path) -> None:
    done = run("convert", robot, "-o", robot.parent / "out" / "r.urdf", "--passes", PASSES)
    assert done.exit_code == 0, done.stderr
    assert (robot.parent / "out" / "meshes" / "ball.obj").is_file()
    again = run("convert", robot, "-o", robot.parent / "out" / "r.urdf", "--passes", PASSES, "--check")
    assert again.exit_code == 0, again.output


@pytest.mark.parametrize("command", [("convert", "--in-place"), ("fix",)])
def test_in_place_they_lie_beside_the_file(run: Run, robot: Path, command: tuple[str, ...]) -> None:
    done = run(*command, robot, "--passes", PASSES)
    assert done.exit_code == 0, done.stderr
    assert robot.read_text() == ROBOT.replace("ball.stl", "ball.obj")
    assert (robot.parent / "meshes" / "ball.obj").read_bytes().count(b"\nv ") == 42


def test_fix_shows_what_would_be_written(run: Run, robot: Path) -> None:
    done = run("fix", robot, "--passes", PASSES, "--diff")
    assert done.exit_code == 1
    assert "meshes/ball.obj would be written" in done.output
    assert not (robot.parent / "meshes" / "ball.obj").exists()


@pytest.mark.parametrize("command", [("convert", "--in-place"), ("fix",)])
def test_nobody_elses_file_is_written_over(run: Run, robot: Path, command: tuple[str, ...]) -> None:
    (robot.parent / "meshes" / "ball.obj").write_text("# mine\n")
    done = run(*command, robot, "--passes", PASSES)
    assert done.exit_code == 2
    assert "twinform has not written it" in done.stderr
    assert (robot.read_text(), (robot.parent / "meshes" / "ball.obj").read_text()) == (ROBOT, "# mine\n")


def test_a_link_that_leads_out_of_the_folder_is_refused(run: Run, robot: Path, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "meshes").symlink_to(tmp_path / "elsewhere")
    done = run("convert", robot, "-o", tmp_path / "out" / "r.urdf", "--passes", PASSES)
    assert done.exit_code == 2
    assert not list((tmp_path / "elsewhere").iterdir())


def test_without_a_folder_for_the_result_there_is_none_for_them(run: Run, robot: Path) -> None:
    done = run("convert", robot, "--passes", PASSES)
    assert done.exit_code == 2
    assert "-o" in done.stderr


@pytest.mark.slow
def test_a_batch_gives_each_model_a_folder(run: Run, robot: Path, tmp_path: Path) -> None:
    (robot.parent / "s.urdf").write_text(ROBOT)
    done = run("batch", "convert", robot.parent, tmp_path / "out", "--to", "urdf", "--passes", PASSES, "--jobs", "1")
    assert done.exit_code == 0, done.stderr
    assert sorted(each.parent.name for each in (tmp_path / "out").rglob("*.obj")) == ["r", "s"]
    assert 'filename="meshes/r/ball.obj"' in (tmp_path / "out" / "r.urdf").read_text()
