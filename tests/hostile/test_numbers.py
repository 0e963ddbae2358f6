"""Numbers at the ends of what a number can be, wherever one stands: no traceback, and no warning of a library."""

from pathlib import Path

import pytest

from testbed import robots
from tests.hostile.child import twinform
from tests.hostile.every_command import run

_EXTREME = ("0", "1e-320", "3e-45", "1e39", "1e155", "1.7e308")
_INERTIA = '<inertia ixx="{0}" iyy="{0}" izz="{0}" ixy="0" ixz="0" iyz="0"/>'
_LINK = (
    '<link name="l{1}"><inertial><origin xyz="{0} -{0} 0"/><mass value="{0}"/>' + _INERTIA + "</inertial>"
    '<visual><origin xyz="{0} 0 0" rpy="{0} 0 0"/><geometry><mesh filename="m.obj" scale="{0} 1 -{0}"/></geometry>'
    '<material name="m{1}"><color rgba="{0} -{0} 0 {0}"/></material></visual>'
    '<visual><geometry><mesh filename="far.obj"/></geometry></visual>'
    '<collision><geometry><cylinder radius="{0}" length="1"/></geometry></collision></link>'
)
_JOINT = (
    '<joint name="j{1}" type="revolute"><origin xyz="{0} 0 -{0}" rpy="0 {0} 0"/><parent link="base"/>'
    '<child link="l{1}"/><axis xyz="{0} 1 0"/><limit lower="-{0}" upper="{0}" effort="{0}" velocity="{0}"/></joint>'
)
_SDF_LINK = (
    '<link name="l{1}"><pose>{0} 0 0 -{0} 0 0</pose><inertial><mass>1</mass></inertial>'
    '<visual name="plane"><geometry><plane><normal>{0} 1 0</normal><size>{0} 1</size></plane></geometry>'
    "<material><diffuse>1 {0} 0</diffuse></material></visual>"
    '<sensor name="lidar" type="gpu_lidar"><lidar><scan><horizontal><samples>3</samples><min_angle>-{0}</min_angle>'
    "<max_angle>{0}</max_angle></horizontal></scan><range><min>0</min><max>{0}</max></range></lidar></sensor>"
    '<sensor name="camera" type="camera"><camera><horizontal_fov>{0}</horizontal_fov><clip><near>{0}</near>'
    "<far>{0}</far></clip><image><width>1</width><height>1</height></image></camera></sensor></link>"
    '<joint name="j{1}" type="ball"><parent>base</parent><child>l{1}</child></joint>'
)


def _many(text: str) -> str:
    return "".join(text.format(value, number) for number, value in enumerate(_EXTREME))


@pytest.fixture
def here(tmp_path: Path) -> Path:
    (tmp_path / "a.urdf").write_text(f'<robot name="a"><link name="base"/>{_many(_LINK)}{_many(_JOINT)}</robot>')
    sdf = f'<model name="a"><link name="base"/>{_many(_SDF_LINK)}</model>'
    (tmp_path / "a.sdf").write_text(f'<sdf version="1.11">{sdf}</sdf>')
    (tmp_path / "b.urdf").write_text(robots.urdf(2))
    (tmp_path / "m.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "far.obj").write_text("v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n")
    return tmp_path


@pytest.mark.parametrize("file", ["a.urdf", "a.sdf"])
@pytest.mark.parametrize(
    "words",
    ["advise", "check --for portable", "convert --to mjcf", "diff b.urdf", "graph", "report -o made.html", "stats"],
)
def test_extreme_numbers_end_in_no_traceback(words: str, file: str, here: Path) -> None:
    command, *more = words.split()
    found = twinform(command, file, *more, folder=here, seconds=8, written=2**28)
    assert found.code in {0, 1, 2}, found.output
    assert "Traceback" not in found.output


@pytest.mark.parametrize("file", ["a.urdf", "a.sdf"])
def test_no_library_warns_of_them(file: str, here: Path) -> None:
    done = run(["report", file, "-o", "made.html"], here)
    assert b"Warning: " not in done.errors
