"""Primitives that are fitted to meshes are those of MuJoCo in SDF, and are fitted again where that becomes MJCF."""

import re
from pathlib import Path
from typing import Any

import pytest

import twinform
from testbed.mjcf.home_trips import came_home

mujoco: Any = pytest.importorskip("mujoco")
np: Any = pytest.importorskip("numpy")
pytest.importorskip("scipy")

_MESH = Path(__file__).parents[1] / "cases/mjcf/parts/tetrahedron.obj"
_KINDS = ("sphere", "capsule", "cylinder", "box", "ellipsoid")
_VERTICES = "0 0 0 1 0 0 0 0.7 0 0.1 0.2 1.5 0.3 0.4 -0.2"


def _model(tmp_path: Path, compiler: str, more: str, shown: str = "plain") -> Path:
    geoms = "".join(
        f'<geom name="{mesh}_{kind}" type="{kind}" mesh="{mesh}" pos="1 2 3" euler="10 20 30" {more}/>'
        for kind in _KINDS
        for mesh in ("own", "tetrahedron", "plain")
    )
    path = tmp_path / "model.xml"
    path.write_text(
        f"""<mujoco model="m"><compiler {compiler}/><asset>
        <mesh name="own" vertex="{_VERTICES}" inertia="convex"/>
        <mesh file="{_MESH}" scale="1 2 0.5" refpos="0.1 0 0"/><mesh name="plain" file="{_MESH}" scale="1 2 5"/>
        </asset><worldbody>
        <body name="base"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>{geoms}
        <geom name="whole" type="mesh" mesh="{shown}"/></body></worldbody></mujoco>"""
    )
    return path


def _axes(quaternion: Any) -> Any:
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, quaternion)
    return matrix.reshape(3, 3)


_CASES = pytest.mark.parametrize("compiler", ["", 'fitaabb="true"'])
_MORE = pytest.mark.parametrize("more", ["", 'fitscale="1.5"', 'contype="0" conaffinity="0"'])


@_CASES
@_MORE
def test_shapes_have_the_size_of_the_mesh(tmp_path: Path, compiler: str, more: str) -> None:
    path = _model(tmp_path, compiler, more)
    model = mujoco.MjModel.from_xml_path(str(path))
    made = twinform.convert(path, to="sdf", paths=[_MESH.parent])
    # without what only we read, so that nothing is fitted again
    plain = twinform.convert(path, to="sdf", paths=[_MESH.parent], carriers=False)
    again = twinform.convert(plain.text.encode(), to="mjcf", paths=[_MESH.parent]).text
    (tmp_path / "again.xml").write_text(again)
    other = mujoco.MjModel.from_xml_path(str(tmp_path / "again.xml"))
    assert not [each for each in made.diagnostics if each.rule.name == "unreadable-mesh"]
    for number in range(model.ngeom):
        name = model.geom(number).name
        assert other.geom(name).size == pytest.approx(model.geom(name).size, abs=1e-5)
        assert other.geom(name).pos == pytest.approx(model.geom(name).pos, abs=1e-5)
        axes, others = (_axes(each.geom(name).quat) for each in (model, other))
        assert np.allclose(np.abs(axes.T @ others), np.eye(3), atol=1e-4)  # half turns are chance, and the same shape


@_CASES
@_MORE
@pytest.mark.parametrize("to", ["sdf", "urdf"])
def test_a_fitted_shape_comes_home(tmp_path: Path, compiler: str, more: str, to: Any) -> None:
    path = _model(tmp_path, compiler, more)
    model = mujoco.MjModel.from_xml_path(str(path))
    made = twinform.convert(path, to=to, paths=[_MESH.parent]).text
    back = twinform.convert(made.encode(), to="mjcf", paths=[_MESH.parent]).text
    assert came_home(mujoco, path, model, back) == []


def test_a_mesh_that_is_shown_too_keeps_its_reference_pose(tmp_path: Path) -> None:
    path = _model(tmp_path, "", "", shown="tetrahedron")
    model = mujoco.MjModel.from_xml_path(str(path))
    made = twinform.convert(path, to="sdf", paths=[_MESH.parent]).text
    back = twinform.convert(made.encode(), to="mjcf", paths=[_MESH.parent]).text
    assert came_home(mujoco, path, model, back) == []


def test_a_shape_with_a_size_of_its_own_is_not_fitted_again(tmp_path: Path) -> None:
    path = _model(tmp_path, "", "")
    made = twinform.convert(path, to="sdf", paths=[_MESH.parent]).text
    edited = re.sub(r"<size>.*?</size>", "<size>0.2 0.4 0.6</size>", made)
    edited = re.sub(r"<mesh>.*?</mesh>", "<box><size>0.2 0.4 0.6</size></box>", edited, flags=re.DOTALL)
    (tmp_path / "edited.xml").write_text(twinform.convert(edited.encode(), to="mjcf", paths=[_MESH.parent]).text)
    other = mujoco.MjModel.from_xml_path(str(tmp_path / "edited.xml"))
    for name in ("own_box", "plain_box", "whole"):
        assert other.geom(name).size == pytest.approx([0.1, 0.2, 0.3])
