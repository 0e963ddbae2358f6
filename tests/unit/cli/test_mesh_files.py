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


EGG = """<sdf version="1.11"><model name="r"><link name="base"><inertial><mass>1</mass></inertial>
<collision name="c"><geometry><ellipsoid><radii>0.1 0.2 0.3</radii></ellipsoid></geometry></collision>
</link></model></sdf>"""


@pytest.fixture
def egg(tmp_path: Path) -> Path:
    (tmp_path / "egg.sdf").write_text(EGG)
    return tmp_path / "egg.sdf"


def test_a_mesh_that_stands_for_a_shape_lies_beside_the_result(run: Run, egg: Path) -> None:
    wanted = egg.parent / "out" / "egg.urdf"
    done = run("convert", egg, "-o", wanted, "--shape-error", "0.001", "--mesh-prefix", "package://egg")
    assert done.exit_code == 0, done.stderr
    (mesh,) = (egg.parent / "out" / "meshes").iterdir()
    assert f'filename="package://egg/meshes/{mesh.name}"' in wanted.read_text()
    assert mesh.read_bytes().count(b"\nf ") == 3024
    mesh.write_text("# mine\n")
    assert "twinform has not written it" in run("convert", egg, "-o", wanted, "--shape-error", "0.001").stderr


@pytest.mark.parametrize("error", ["0", "-1", "inf", "small"])
def test_an_error_of_a_shape_is_a_distance(run: Run, egg: Path, error: str) -> None:
    assert run("convert", egg, "-o", egg.parent / "egg.urdf", "--shape-error", error).exit_code == 2


def test_a_printed_result_has_no_place_for_a_mesh(run: Run, egg: Path) -> None:
    done = run("convert", egg)
    assert done.exit_code == 0
    assert "egg.sdf:2:2: warning: collision 'c' of link 'base' is an ellipsoid" in done.stderr
    assert "name a file for the result with -o" in done.stderr
    assert [*egg.parent.iterdir()] == [egg]


def test_a_mesh_that_is_read_may_be_what_is_written(run: Run, egg: Path) -> None:
    robot, older = egg.with_suffix(".urdf"), egg.parent / "older.sdf"
    for done in (
        run("convert", egg, "-o", robot),
        run("convert", robot, "-o", older, "--sdf-version", "1.7"),
        run("convert", egg, "--into", robot),
        run("convert", older, "--in-place", "--sdf-version", "1.9"),
    ):
        assert done.exit_code == 0, done.stderr
    assert "<ellipsoid>" in older.read_text()


def test_a_package_takes_meshes_of_shapes_along(run: Run, egg: Path) -> None:
    done = run("package", egg, "-o", egg.parent / "egg", "--kind", "both")
    assert done.exit_code == 0, done.stderr
    (mesh,) = (egg.parent / "egg" / "meshes").iterdir()
    assert f"package://egg/meshes/{mesh.name}" in (egg.parent / "egg" / "urdf" / "egg.urdf").read_text()
    assert "<ellipsoid>" in (egg.parent / "egg" / "model.sdf").read_text()
