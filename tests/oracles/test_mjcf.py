"""What MuJoCo makes of our MJCF: the robot that it reads from the URDF itself, and that Drake reads from the SDF."""

import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from lxml import etree

import twinform
from tests.snippets import STL
from twinform.compiler import CompileError
from twinform.compiler.output.emitting import document_text
from twinform.ir import Box, Capsule, Cylinder, Document, Ellipsoid, Sphere
from twinform.testing import strategies

np: Any = pytest.importorskip("numpy")
pytest.importorskip("mujoco")

from testbed.engines.readers.meshless import without_meshes as boxed  # noqa: E402
from testbed.mjcf.compiled import UnreadableError, compile_mjcf, compile_urdf, without_meshes  # noqa: E402
from testbed.mjcf.differences import differences  # noqa: E402
from testbed.mjcf.mesh_robots import MissingFileError, mesh_robots, with_files  # noqa: E402

_ROOT = Path(__file__).parents[2]
_CASES = _ROOT / "tests/cases"
_EXAMPLES = [_ROOT / "examples" / name for name in ("arm.urdf", "rover.urdf", "four_wheels.urdf", "sensor_base.urdf")]
_SHAPES = (Box, Capsule, Cylinder, Ellipsoid, Sphere)
_REFUSALS = frozenset({"massless-link", "unbalanced-inertia", "indefinite-inertia", "automatic-inertia"})
"""What a model may be refused for that MuJoCo would refuse."""
_GEARBOX = re.compile(r'<joint name="gears".*?</joint>', re.DOTALL)
_OCTAHEDRON = """v 1 0 0
v -1 0 0
v 0 1.5 0
v 0 -1 0
v 0 0 1
v 0 0 -2
f 1 3 5
f 3 2 5
f 2 4 5
f 4 1 5
f 3 1 6
f 2 3 6
f 4 2 6
f 1 4 6
"""


@pytest.mark.parametrize("path", _EXAMPLES, ids=lambda path: path.name)
def test_a_robot_of_urdf_is_the_one_that_mujoco_reads(path: Path) -> None:
    text = boxed(path.read_bytes())
    made = compile_mjcf(twinform.convert(text, to="mjcf").text)
    assert differences(compile_urdf(text, absent_is_nothing=True), made) == []


@pytest.mark.parametrize("name", ["refused_massless.urdf", "refused_inertia.sdf"])
def test_what_mujoco_refuses_is_changed_where_that_is_asked_for(name: str) -> None:
    compile_mjcf(twinform.convert(_CASES / "to_mjcf" / name, to="mjcf", profiles="mujoco").text)


def test_a_thin_body_is_loaded_whose_matrix_mujoco_refuses() -> None:
    source = _CASES / "to_mjcf/thin_inertia.urdf"
    with pytest.raises(UnreadableError, match="positive eigenvalues"):
        compile_urdf(source.read_bytes(), absent_is_nothing=True)
    made = compile_mjcf(twinform.convert(source, to="mjcf").text)
    assert sorted(made.model.body("pin").inertia) == pytest.approx([1.0723e-15, 1e-7, 1e-7], rel=1e-9)


def test_a_mesh_is_where_mujoco_puts_that_of_the_urdf(tmp_path: Path) -> None:
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes/part.obj").write_text(_OCTAHEDRON)
    mesh = f'<geometry><mesh filename="{tmp_path}/meshes/part.obj" scale="1 2 0.5"/></geometry>'
    body = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    origin = '<origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/>'
    path = tmp_path / "robot.urdf"
    path.write_text(
        f'<robot name="r"><link name="a"/><link name="b">{body}<visual>{origin}{mesh}</visual>'
        f'<collision name="c">{origin}{mesh}</collision></link><joint name="j" type="continuous">'
        '<parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>'
    )
    source = compile_urdf(path.read_bytes(), absent_is_nothing=True)
    made = twinform.convert(path, to="mjcf").text
    assert made.count("<mesh ") == 1
    assert differences(source, compile_mjcf(made, str(tmp_path))) == []
    moved = compile_mjcf(made.replace('scale="1 2 0.5"', 'scale="1 2 0.501"'), str(tmp_path))
    assert any("geom" in each and "missing" in each for each in differences(source, moved))


def test_a_robot_with_meshes_of_a_package_is_made_readable(tmp_path: Path) -> None:
    pytest.importorskip("trimesh")
    robot, made = tmp_path / "arm" / "urdf" / "arm.urdf", tmp_path / "made"
    for folder in (robot.parent, made, tmp_path / "arm" / "meshes"):
        folder.mkdir(parents=True)
    (tmp_path / "arm/meshes/flat.STL").write_bytes(STL)
    (tmp_path / "arm/meshes/part.obj").write_text(_OCTAHEDRON)
    meshes = ("package://arm/meshes/part.obj", "package://arm/meshes/flat.STL", "../meshes/part.obj")
    visuals = "".join(f'<visual><geometry><mesh filename="{each}"/></geometry></visual>' for each in meshes)
    robot.write_text(f'<robot name="r"><link name="a">{visuals}</link></robot>')
    assert mesh_robots(tmp_path) == [robot]
    part, flat, same = (
        Path(each.get("filename", "")) for each in etree.fromstring(with_files(robot, made)).iter("mesh")
    )
    assert part.samefile(same)
    assert part.samefile(tmp_path / "arm/meshes/part.obj")
    assert (flat.parent, flat.suffix) == (made, ".obj")
    (tmp_path / "arm/meshes/part.obj").unlink()
    with pytest.raises(MissingFileError, match=r"part\.obj"):
        with_files(robot, made)


_PAINT = "newmtl red\nKd 0.8 0.1 0.2\nd 0.5\nnewmtl blue\nKd 0 0 1\n"


@pytest.mark.parametrize(
    ("used", "own", "expected"),
    [
        (["red"], "", (0.8, 0.1, 0.2, 0.5)),
        (["red", "blue"], "", (0.5, 0.5, 0.5, 1)),
        (["red"], '<material name="g"><color rgba="0 1 0 1"/></material>', (0, 1, 0, 1)),
    ],
    ids=["one", "several", "own"],
)
def test_the_color_of_a_mesh_file_is_that_of_its_geom(
    tmp_path: Path, used: list[str], own: str, expected: tuple[float, ...]
) -> None:
    faces = _OCTAHEDRON.replace("f 1 3 5", f"usemtl {used[0]}\nf 1 3 5").replace(
        "f 3 1 6", f"usemtl {used[-1]}\nf 3 1 6"
    )
    (tmp_path / "part.obj").write_text(f"mtllib part.mtl\n{faces}")
    (tmp_path / "part.mtl").write_text(_PAINT)
    path = tmp_path / "robot.urdf"
    mesh = '<visual><geometry><mesh filename="part.obj"/></geometry>'
    path.write_text(f'<robot name="r"><link name="a">{mesh}{own}</visual></link></robot>')
    made = twinform.convert(path, to="mjcf")
    assert compile_mjcf(made.text, str(tmp_path)).model.geom_rgba[0] == pytest.approx(expected)
    assert ["several colors" in each.message for each in made.ledger.entries].count(True) == len(used) - 1
    home = twinform.convert(made.text.encode(), to="urdf").text
    assert ("<material" in home) == bool(own)
    if not own and len(used) == 1:
        edited = twinform.convert(made.text.replace("0.8 0.1 0.2 0.5", "0 0 1 1").encode(), to="urdf").text
        assert 'rgba="0 0 1 1"' in edited


_FLAT = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"


@pytest.mark.parametrize(
    ("points", "seen", "touched"),
    [(_OCTAHEDRON, True, True), (_FLAT, True, False), ("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3\n", False, False)],
    ids=["solid", "flat", "line"],
)
def test_a_mesh_without_a_volume_is_written_as_mujoco_takes_it(
    tmp_path: Path, points: str, *, seen: bool, touched: bool
) -> None:
    (tmp_path / "part.obj").write_text(points)
    for tag, is_written in (("visual", seen), ("collision", touched)):
        path = tmp_path / f"{tag}.urdf"
        shape = f'<{tag}><geometry><mesh filename="part.obj"/></geometry></{tag}>'
        path.write_text(f'<robot name="r">\n<link name="a">\n{shape}\n</link>\n</robot>')
        made = twinform.convert(path, to="mjcf")
        compile_mjcf(made.text, str(tmp_path))
        assert ("<geom" in made.text) == is_written
        assert [each.location.line for each in made.diagnostics if each.rule.name == "unreadable-mesh"] == (
            [] if is_written else [3]
        )
        back = twinform.convert(made.text.encode(), to="urdf").text
        assert "shell" not in back
        assert back.count("part.obj") == 1


@given(strategies.robots(shapes=_SHAPES))
@settings(deadline=None)
def test_mujoco_reads_every_robot_that_is_written(robot: Document) -> None:
    _assert_read(robot)


@given(strategies.sdf_models(shapes=_SHAPES))
@settings(deadline=None)
def test_mujoco_reads_every_model_that_is_written(model: Document) -> None:
    _assert_read(model)


def _assert_read(document: Document) -> None:
    """MuJoCo reads what is written of a document, or it is refused for what MuJoCo would refuse."""
    text = document_text(document).encode()
    try:
        made = twinform.convert(text, to="mjcf").text
    except CompileError as error:
        refused = {each.rule.name for each in error.diagnostics if each.is_error}
    else:
        refused = set[str]()
        compile_mjcf(without_meshes(made))
    assert refused <= _REFUSALS


@given(strategies.robots(shapes=_SHAPES))
@settings(deadline=None)
def test_every_robot_moves_as_the_one_that_mujoco_reads(robot: Document) -> None:
    text = document_text(robot).encode()
    try:
        source = compile_urdf(text, absent_is_nothing=True)
    except UnreadableError:
        return
    found = differences(source, compile_mjcf(twinform.convert(text, to="mjcf").text))
    assert [each for each in found if not _holds_still(each)] == []


def _holds_still(difference: str) -> bool:
    """Whether a difference is that MuJoCo's URDF reader takes two equal ends of a range for no limit."""
    ends = _UNLIMITED.search(difference)
    return ends is not None and float(ends["upper"]) - float(ends["lower"]) < _STILL


_UNLIMITED = re.compile(r"range of joint .*: \(\) is \((?P<lower>[^,]+), (?P<upper>[^)]+)\)$")
_STILL = 1e-8


def test_joints_of_sdf_move_as_in_drake(tmp_path: Path) -> None:
    pytest.importorskip("pydrake")
    from testbed.mjcf.from_drake import differences_from_drake  # noqa: PLC0415 - it needs Drake

    path = tmp_path / "chains.sdf"
    # Drake has no gearbox, and refuses a file with one.
    path.write_text(_GEARBOX.sub("", (_CASES / "to_mjcf/chains.sdf").read_text(encoding="utf-8")))
    assert differences_from_drake(path, compile_mjcf(twinform.convert(path, to="mjcf").text)) == []
