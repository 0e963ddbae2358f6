"""The pass `self-collide`, by the contacts that MuJoCo finds between the links of a robot."""

from pathlib import Path
from typing import Any

import pytest

import twinform

mujoco: Any = pytest.importorskip("mujoco")

_LINK = (
    '<link name="{0}"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    '<collision name="{0}"><geometry><sphere radius="0.1"/></geometry></collision></link>'
)
_JOINT = '<joint name="to_{1}" type="continuous"><parent link="{0}"/><child link="{1}"/></joint>'
_NAMES = "abcd"
_ROBOT = "".join(map(_LINK.format, _NAMES)) + "".join(map(_JOINT.format, _NAMES, _NAMES[1:]))
_DISABLED = '<disable_collisions link1="{}" link2="{}" reason="Never"/>'


def _contacts(folder: Path, passes: str) -> set[str]:
    """The pairs of links that touch, of four balls in one place, each on the one before."""
    file = folder / "robot.urdf"
    file.write_text(f'<robot name="robot">{_ROBOT}</robot>')
    model = mujoco.MjModel.from_xml_string(twinform.convert(file, to="mjcf", passes=passes).text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return {"".join(sorted((model.geom(each.geom1).name, model.geom(each.geom2).name))) for each in data.contact}


def test_links_touch_all_others_but_those_that_joints_connect(tmp_path: Path) -> None:
    # The base is fixed to the world, and MuJoCo lets a child touch a parent that is.
    assert _contacts(tmp_path, "") == set()
    assert _contacts(tmp_path, "self-collide") == {"ac", "ad", "bd"}


@pytest.mark.parametrize(
    ("semantics", "left"),
    [
        (_DISABLED.format("d", "a"), {"ac", "bd"}),
        (_DISABLED.format("a", "c") + _DISABLED.format("b", "d"), {"ad"}),
        ('<disable_default_collisions link="d"/>', {"ac"}),
        ('<disable_default_collisions link="d"/><enable_collisions link1="b" link2="d"/>', {"ac", "bd"}),
    ],
)
def test_what_an_srdf_disables_does_not_touch(tmp_path: Path, semantics: str, left: set[str]) -> None:
    (tmp_path / "robot.srdf").write_text(f'<robot name="robot">{semantics}</robot>')
    assert _contacts(tmp_path, "self-collide{srdf=robot.srdf}") == left
