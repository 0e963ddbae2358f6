"""Masses of hollow geoms, and of primitives that are fitted to meshes, are those of MuJoCo."""

import math
import random
from pathlib import Path
from typing import Any

import pytest

import twinform
from twinform.ir.solids import tensor, turned
from twinform.ir.transform import Transform
from twinform.passes.mesh_jobs.obj_polygons import split_polygons

mujoco: Any = pytest.importorskip("mujoco")
np: Any = pytest.importorskip("numpy")

_MESH = Path(__file__).parents[1] / "cases/mjcf/parts/tetrahedron.obj"
_TWO, _THREE = "0.1 0.2", "0.1 0.2 0.3"
_SIZES = {"sphere": "0.2", "capsule": _TWO, "cylinder": _TWO, "box": _THREE, "ellipsoid": _THREE}
_SHELL = 'shellinertia="true" density="30"'


def _load(tmp_path: Path, geoms: list[str], compiler: str = "") -> Path:
    bodies = "".join(f'<body name="b{n}"><joint/>{geom}</body>' for n, geom in enumerate(geoms))
    path = tmp_path / "model.xml"
    path.write_text(
        f'<mujoco model="m"><compiler {compiler}/>'
        f'<asset><mesh name="t" file="{_MESH}" scale="1 2 0.5" refpos="0.1 0 0"/></asset>'
        f'<worldbody><body name="base"><geom size="1"/>{bodies}</body></worldbody></mujoco>'
    )
    return path


def _inertia(model: Any, body: int) -> Any:
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, model.body_iquat[body])
    turn = matrix.reshape(3, 3)
    return turn @ np.diag(model.body_inertia[body]) @ turn.T


def _are_the_same(path: Path, tolerance: float) -> None:
    model = mujoco.MjModel.from_xml_path(str(path))
    (robot,) = twinform.load(path, paths=[_MESH.parent]).models
    for number in range(2, model.nbody):
        inertial = robot.link(model.body(number).name).inertial
        assert inertial is not None
        assert inertial.inertia is not None
        at = Transform.from_pose(inertial.pose)
        xx, yy, zz, xy, xz, yz = turned(tensor(inertial.inertia, 0.0), at)
        assert inertial.mass == pytest.approx(model.body_mass[number], rel=tolerance)
        assert at.translation == pytest.approx(tuple(model.body_ipos[number]), abs=tolerance)
        own = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        assert np.allclose(own, _inertia(model, number), rtol=0, atol=tolerance * own.max())


def test_hollow_geoms(tmp_path: Path) -> None:
    geoms = [f'<geom type="{kind}" size="{size}" pos="1 2 3" {_SHELL}/>' for kind, size in _SIZES.items()]
    _are_the_same(_load(tmp_path, geoms), 1e-9)


@pytest.mark.parametrize("compiler", ["", 'fitaabb="true"'])
@pytest.mark.parametrize("more", ["", 'fitscale="1.5"', 'mass="3"', _SHELL, 'pos="1 2 3" euler="10 20 30"'])
def test_geoms_that_are_fitted_to_a_mesh(tmp_path: Path, more: str, compiler: str) -> None:
    geoms = [f'<geom type="{kind}" mesh="t" {more}/>' for kind in _SIZES]
    _are_the_same(_load(tmp_path, geoms, compiler), 1e-5)  # MuJoCo has the points of meshes in single precision


@pytest.mark.parametrize("inertia", ["legacy", "exact", "convex", "shell"])
@pytest.mark.parametrize("faces", ["", 'face="0 2 1 0 1 3 0 3 2 1 2 3"'])
def test_meshes_whose_vertices_stand_in_the_file(tmp_path: Path, inertia: str, faces: str) -> None:
    path = tmp_path / "model.xml"
    path.write_text(
        f'''<mujoco model="m"><asset><mesh name="t" inertia="{inertia}" vertex="0 0 0 1 0 0 0 1 0 0 0.1 1.5" {faces}
        scale="1 2 0.5" refpos="0.1 0 0"/></asset><worldbody><body name="base"><geom size="1"/>
        <body name="a"><joint/><geom type="mesh" mesh="t" pos="1 2 3" euler="10 20 30"/></body>
        <body name="b"><joint/><geom type="box" mesh="t"/></body></body></worldbody></mujoco>'''
    )
    _are_the_same(path, 1e-5)


@pytest.mark.parametrize("inertia", ["legacy", "exact", "convex", "shell"])
def test_a_file_of_points_without_triangles_is_their_hull(tmp_path: Path, inertia: str) -> None:
    corners = "".join(f"v {x} {y} {z}\n" for x in (-1, 1) for y in (-2, 2) for z in (-3, 3))
    (tmp_path / "points.obj").write_text(corners + "v 0.1 0.2 0.3\n")
    path = tmp_path / "model.xml"
    path.write_text(
        f'''<mujoco model="m"><asset><mesh name="t" file="points.obj" inertia="{inertia}" scale="1 -2 0.5"/></asset>
        <worldbody><body name="base"><geom size="1"/>
        <body name="a"><joint/><geom type="mesh" mesh="t" pos="1 2 3" euler="10 20 30"/></body></body></worldbody>
        </mujoco>'''
    )
    _are_the_same(path, 1e-5)
    found = [each.message for each in twinform.check(path).diagnostics if each.rule.name == "unreadable-mesh"]
    hull = "its mass is that of the convex hull of its points, as in MuJoCo"
    assert found == [f"the mesh 'points.obj' cannot be read: it has no triangles, so that {hull}"]


def test_a_flat_mesh_has_no_mass(tmp_path: Path) -> None:
    path = tmp_path / "model.xml"
    path.write_text(
        """<mujoco model="m"><asset><mesh name="t" vertex="0 0 0 1 0 0 0 1 0 1 1 0"/></asset><worldbody>
        <body name="base"><geom type="mesh" mesh="t"/></body></worldbody></mujoco>"""
    )
    assert "unreadable-mesh" in {each.rule.name for each in twinform.check(path).diagnostics}


_INERTIAL = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'


@pytest.mark.parametrize(
    ("inertial", "message"),
    [
        ("", "this geom is a box that only MuJoCo can measure, so that it counts for no mass"),
        (_INERTIAL, "'missing.obj' is not found, so that it gives its size to no shape"),
    ],
)
def test_what_cannot_be_measured_is_reported(tmp_path: Path, inertial: str, message: str) -> None:
    path = _load(tmp_path, [f'{inertial}<geom type="box" mesh="t"/>'])
    path.write_text(path.read_text().replace(str(_MESH), "missing.obj"))
    found = twinform.check(path).diagnostics
    assert [each.message for each in found if each.rule.name == "unreadable-mesh"] == [message]


def test_a_mesh_with_faces_that_are_not_flat(tmp_path: Path) -> None:
    corners = [(x, y, z + 0.4 * x * y) for z in (0, 1) for y in (0, 1) for x in (0, 1.5)]
    faces = ("1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6")
    lines = [*(f"v {x} {y} {z}" for x, y, z in corners), *(f"f {face}" for face in faces)]
    (tmp_path / "bent.obj").write_text("\n".join(lines) + "\n")
    path = tmp_path / "model.xml"
    body = '<body name="bent"><joint/><geom type="mesh" mesh="bent"/></body>'
    path.write_text(
        '<mujoco model="m"><asset><mesh file="bent.obj"/></asset>'
        f'<worldbody><body name="base"><geom size="1"/>{body}</body></worldbody></mujoco>'
    )
    _are_the_same(path, 1e-6)


_SEVERAL = 10
"""Of polygons with fewer corners there are more, since the search for ears ends in few of them."""


def _polygons(draw: random.Random, corners: int) -> str:
    """A tetrahedron, and polygons around several places, some of them bent, concave or crossing themselves."""
    points, faces = ["v 0 0 0", "v 1 0 0", "v 0 1 0", "v 0 0 1"], ["f 1 3 2", "f 1 2 4", "f 1 4 3", "f 2 3 4"]
    for number in range(48 if corners < _SEVERAL else 12):
        turns = sorted(draw.uniform(0, 2 * math.pi) for _ in range(corners))
        radii = [draw.uniform(0.2, 1.0) if number % 2 else 1.0 for _ in turns]
        around = [(radius * math.cos(turn), radius * math.sin(turn)) for radius, turn in zip(radii, turns, strict=True)]
        flat = [(2 * number + x, y, 3 + number % 3 * draw.uniform(0.0, 0.3)) for x, y in around]
        turned = [each[number % 3 :] + each[: number % 3] for each in flat]
        faces.append(f"f {' '.join(str(len(points) + 1 + index) for index in range(corners))}")
        points += [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in turned]
    return "\n".join([*points, *faces]) + "\n"


@pytest.mark.parametrize("corners", [4, 5, 6, 9, 30, 100, 101])
def test_polygons_are_split_into_the_triangles_of_mujoco(tmp_path: Path, corners: int) -> None:
    """MuJoCo drops triangles without an area, of which there are none."""
    text = _polygons(random.Random(corners), corners)
    file = tmp_path / f"polygons_of_{corners}.obj"  # MuJoCo remembers a file by its name
    file.write_text(text)
    asset = f'<asset><mesh name="m" file="{file}" inertia="convex"/></asset>'
    model = mujoco.MjModel.from_xml_string(f"<mujoco>{asset}</mujoco>")
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.mesh_quat[0])
    theirs = model.mesh_vert @ turn.reshape(3, 3).T + model.mesh_pos[0]
    lines = [line.split() for line in split_polygons(text.encode()).decode().splitlines()]
    points = np.array([[float(word) for word in words[1:]] for words in lines if words[0] == "v"])
    ours = np.array([[int(word) - 1 for word in words[1:]] for words in lines if words[0] == "f"])
    nearest = np.array([np.abs(points - each).sum(axis=1).argmin() for each in theirs])
    assert _corner_sets(ours) == _corner_sets(nearest[model.mesh_face])


def _corner_sets(faces: Any) -> list[list[int]]:
    return sorted(sorted(each) for each in faces.tolist())
