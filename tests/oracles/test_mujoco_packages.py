"""MuJoCo loads the folders of `package --kind mujoco` wherever they lie, with meshes of all kinds."""

import importlib
import shutil
import struct
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from tests.unit.compiler.packaging.robots import ARM, FILES
from tests.write_files import write_files
from twinform.cli import main
from twinform.testing import oracles

pytestmark = pytest.mark.slow

_CORNERS = ("0 0 0", "1 0 0", "0 1 0", "0 0 1")
_FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))


def _facet(face: tuple[int, ...]) -> str:
    corners = "".join(f"vertex {_CORNERS[each]}\n" for each in face)
    return f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n"


STL_TEXT = f"solid t\n{''.join(map(_facet, _FACES))}endsolid t\n".encode()
_TRIANGLES = b"".join(
    struct.pack("<12fH", 0, 0, 0, *(float(number) for each in face for number in _CORNERS[each].split()), 0)
    for face in _FACES
)
STL_BINARY = bytes(80) + struct.pack("<I", len(_FACES)) + _TRIANGLES
COLLADA = f"""<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.001" name="millimeter"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">{" ".join(_CORNERS).replace("1", "1000")}</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<p>{" ".join(str(each) for face in _FACES for each in face)}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
""".encode()


def _mujoco() -> Any:
    if not oracles.available("mujoco"):
        pytest.skip("mujoco is not installed")
    return importlib.import_module("mujoco")


def _package(source: Path, folder: Path, *more: str) -> Result:
    words = ["package", str(source), "-o", str(folder), "--kind", "mujoco", *more]
    return CliRunner().invoke(main, words, catch_exceptions=False)


def _arm(folder: Path, base: str = "base.STL", content: bytes = STL_BINARY) -> Path:
    """Write the arm with meshes that are solids, and another file for its collision."""
    robot = ARM.replace("collision/base.STL", f"collision/{base}").encode()
    files = {name: data for name, data in FILES.items() if name != "meshes/collision/base.STL"}
    files |= {"urdf/arm.urdf": robot, "meshes/tip one.stl": STL_TEXT, f"meshes/collision/{base}": content}
    return write_files(folder / "arm_description", files) / "urdf/arm.urdf"


@pytest.mark.parametrize(("base", "content"), [("base.STL", STL_BINARY), ("base.stl", STL_TEXT), ("base.dae", COLLADA)])
def test_a_folder_loads_from_anywhere_with_all_its_meshes(base: str, content: bytes, tmp_path: Path) -> None:
    mujoco = _mujoco()
    source = _arm(tmp_path, base, content)
    done = _package(source, tmp_path / "made")
    assert done.exit_code == 0, done.output
    shutil.rmtree(source.parents[1])
    moved = (tmp_path / "made").rename(tmp_path / "moved somewhere else")
    robot = mujoco.MjModel.from_xml_path(str(moved / "model.xml"))
    scene = mujoco.MjModel.from_xml_path(str(moved / "scene.xml"))
    assert (robot.nmesh, robot.nbody, robot.njnt) == (3, 3, 1)
    assert (scene.nmesh, scene.ngeom, scene.nlight) == (3, robot.ngeom + 1, 1)
    # A meter is a meter in each format: the corner at 1 m is that far from the center of the mesh at a quarter.
    for number in range(robot.nmesh):
        start, count = robot.mesh_vertadr[number], robot.mesh_vertnum[number]
        distances = ((robot.mesh_vert[start : start + count]) ** 2).sum(axis=1) ** 0.5
        assert distances.max() == pytest.approx((0.75**2 + 2 * 0.25**2) ** 0.5, rel=1e-6)
    assert {each.name for each in (moved / "assets").rglob("*.dae")} == set()


def test_a_world_has_its_own_ground_and_light(tmp_path: Path) -> None:
    mujoco = _mujoco()
    world = tmp_path / "hall.sdf"
    world.write_text(
        '<sdf version="1.9"><world name="hall"><light name="sun" type="directional">'
        "<direction>0 0 -1</direction></light>"
        '<model name="floor"><static>true</static><link name="l"><collision name="c"><geometry><plane>'
        "<normal>0 0 1</normal></plane></geometry></collision></link></model>"
        '<model name="ball"><pose>0 0 1 0 0 0</pose><link name="l"><inertial><mass>1</mass></inertial>'
        '<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model>'
        "</world></sdf>"
    )
    done = _package(world, tmp_path / "hall")
    assert done.exit_code == 0, done.output
    scene = mujoco.MjModel.from_xml_path(str(tmp_path / "hall/scene.xml"))
    assert (scene.ngeom, scene.nlight, scene.nv) == (2, 1, 6)


def test_a_part_called_as_the_ground_keeps_its_name(tmp_path: Path) -> None:
    mujoco = _mujoco()
    source = tmp_path / "r.urdf"
    source.write_text(
        '<robot name="r"><link name="ground"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" '
        'iyz="0" izz="1"/></inertial><collision name="ground"><geometry><box size="1 1 1"/></geometry></collision>'
        "</link></robot>"
    )
    assert _package(source, tmp_path / "made").exit_code == 0
    scene = mujoco.MjModel.from_xml_path(str(tmp_path / "made/scene.xml"))
    assert {scene.geom(number).name for number in range(scene.ngeom)} == {"ground", "ground_2"}


def test_a_missing_mesh_is_an_error_and_nothing_is_written(tmp_path: Path) -> None:
    source = _arm(tmp_path)
    (source.parents[1] / "meshes/tip one.stl").unlink()
    done = _package(source, tmp_path / "made")
    assert (done.exit_code, (tmp_path / "made").exists()) == (1, False)
    assert "unpackaged-file" in done.output


def test_textures_are_written_as_png(tmp_path: Path) -> None:
    mujoco, image = _mujoco(), importlib.import_module("PIL.Image")
    image.new("RGB", (4, 4), (200, 30, 30)).save(tmp_path / "wood.jpg")
    (tmp_path / "r.urdf").write_text(
        '<robot name="r"><material name="wood"><texture filename="wood.jpg"/></material><link name="a"><visual>'
        '<geometry><box size="1 1 1"/></geometry><material name="wood"/></visual></link></robot>'
    )
    done = _package(tmp_path / "r.urdf", tmp_path / "made")
    assert done.exit_code == 0, done.output
    assert "unreadable-image" not in done.output
    (tmp_path / "wood.jpg").unlink()
    robot = mujoco.MjModel.from_xml_path(str(tmp_path / "made/model.xml"))
    assert (robot.ntex, robot.nmat) == (1, 1)
    assert abs(int(robot.tex_data[0]) - 200) < 8
