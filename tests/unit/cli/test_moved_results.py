"""Results that lie in another folder than their sources: relative paths of meshes lead to the same files."""

from pathlib import Path

import pytest

from .conftest import Run

ROBOT = """<robot name="r"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision name="c"><geometry><mesh filename="../meshes/ball.obj"/></geometry></collision></link></robot>"""


@pytest.fixture
def robot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A robot in a folder beside that of its mesh."""
    monkeypatch.chdir(tmp_path)
    for folder in ("urdf", "meshes"):
        Path(folder).mkdir()
    Path("meshes/ball.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    Path("urdf/r.urdf").write_text(ROBOT)
    return Path("urdf/r.urdf")


@pytest.mark.parametrize(
    ("to", "place", "written"),
    [
        ("mjcf", "out/deep/r.xml", 'file="../../meshes/ball.obj"'),
        ("sdf", "out/deep/r.sdf", "<uri>../../meshes/ball.obj</uri>"),
        ("urdf", "r.urdf", 'filename="meshes/ball.obj"'),
        ("mjcf", "urdf/r.xml", 'file="../meshes/ball.obj"'),
    ],
)
def test_a_path_leads_from_the_folder_of_the_result(run: Run, robot: Path, to: str, place: str, written: str) -> None:
    done = run("convert", robot, "--to", to, "-o", place)
    assert done.exit_code == 0
    assert written in Path(place).read_text()


def test_a_path_stays_for_a_result_that_is_moved_beside_its_source(run: Run, robot: Path) -> None:
    assert run("convert", robot, "--to", "mjcf", "--keep-paths", "-o", "out/deep/r.xml").exit_code == 0
    assert 'file="../meshes/ball.obj"' in Path("out/deep/r.xml").read_text()
    assert 'filename="../meshes/ball.obj"' in run("convert", robot, "--to", "urdf").stdout


def test_a_path_in_a_package_leads_from_the_folder_of_the_result(run: Run, robot: Path) -> None:
    Path("package.xml").write_text("<package><name>r</name></package>")
    robot.write_text(ROBOT.replace("../meshes", "package://r/meshes"))
    assert run("convert", robot, "--to", "mjcf", "-o", "out/deep/r.xml").exit_code == 0
    assert 'file="../../meshes/ball.obj"' in Path("out/deep/r.xml").read_text()


def test_a_path_without_a_file_is_reported_and_stays(run: Run, robot: Path) -> None:
    Path("meshes/ball.obj").unlink()
    done = run("convert", robot, "--to", "mjcf", "-o", "out/deep/r.xml")
    assert "[missing-file]" in done.stderr
    assert 'file="../meshes/ball.obj"' in Path("out/deep/r.xml").read_text()


def test_meshes_that_a_pass_writes_lie_beside_the_result(run: Run, robot: Path) -> None:
    pytest.importorskip("trimesh")
    asked = ("--path", "meshes", "--passes", "convert-meshes{to=stl}")
    assert run("convert", robot, "--to", "mjcf", *asked, "-o", "out/deep/r.xml").exit_code == 0
    assert 'file="meshes/ball.stl"' in Path("out/deep/r.xml").read_text()
    assert Path("out/deep/meshes/ball.stl").is_file()


def test_files_in_several_folders_are_kept_the_same(run: Run, robot: Path) -> None:
    files = [robot, "sdf/deep/r.sdf", "mjcf/deep/r.xml"]
    assert run("sync", *files).exit_code == 0
    assert 'file="../../meshes/ball.obj"' in Path("mjcf/deep/r.xml").read_text()
    assert run("sync", *files, "--check").exit_code == 0
    robot.write_text(ROBOT.replace('mass value="1"', 'mass value="2"'))
    assert run("sync", *files).exit_code == 0
    for text in (Path("sdf/deep/r.sdf").read_text(), Path("mjcf/deep/r.xml").read_text()):
        assert "../../meshes/ball.obj" in text
    assert run("sync", *files, "--check").exit_code == 0
    assert run("convert", robot, "--into", "mjcf/deep/r.xml").stderr.endswith("stays as it is\n")


SKY = """<mujoco model="r"><asset><texture name="sky" type="skybox" file="sky.png"/></asset><worldbody>
<body name="base"><geom name="ball" size="1"/></body></worldbody></mujoco>"""


def test_what_only_mjcf_has_leads_to_the_same_file_too(run: Run, robot: Path) -> None:
    Path("urdf/sky.png").touch()
    Path("urdf/r.xml").write_text(SKY)
    assert run("convert", "urdf/r.xml", "-o", "out/r.sdf").exit_code == 0
    assert 'file="../urdf/sky.png"' in Path("out/r.sdf").read_text()
    assert run("convert", "out/r.sdf", "--to", "mjcf", "-o", "out/deep/r.xml").exit_code == 0
    assert 'file="../../urdf/sky.png"' in Path("out/deep/r.xml").read_text()


def test_a_package_takes_what_only_mjcf_has_along(run: Run, robot: Path) -> None:
    Path("urdf/sky.png").touch()
    Path("urdf/r.xml").write_text(SKY)
    assert run("package", "urdf/r.xml", "-o", "out/r", "--kind", "mujoco").exit_code == 0
    assert Path("out/r/assets/sky.png").is_file()
    assert 'file="assets/sky.png"' in Path("out/r/model.xml").read_text()
