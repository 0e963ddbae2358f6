"""The floating joint of a URDF gives its name to the free joint, and takes that of the file when it comes back."""

import pytest

import twinform

_BODY = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
_URDF = (
    f'<robot name="drone"><link name="world"/><link name="frame">{_BODY}</link>'
    '<joint name="air" type="floating"><parent link="world"/><child link="frame"/></joint></robot>'
)
_FREE = '<freejoint name="air"/>'


@pytest.mark.parametrize(
    ("edited", "name", "kept"),
    [
        (_FREE, "air", ""),
        ('<freejoint name="sky"/>', "sky", ""),
        ("<freejoint/>", "air", ""),
        ('<freejoint name="air" group="2"/>', "air", '<freejoint group="2"/>'),
    ],
)
def test_the_name_of_the_file_wins(edited: str, name: str, kept: str) -> None:
    made = twinform.convert(_URDF.encode(), to="mjcf").text
    assert _FREE in made
    back = twinform.convert(made.replace(_FREE, edited).encode(), to="urdf").text
    assert f'<joint name="{name}" type="floating">' in back
    assert ("<freejoint" in back) == bool(kept)
    assert kept in back


def test_a_robot_in_a_world_has_no_name_for_it() -> None:
    model = twinform.convert(_URDF.encode(), to="sdf").text.partition("<model")[2].rpartition("</model>")[0]
    world = f'<sdf version="1.11" xmlns:tf="urn:twinform:1"><world name="sky"><model{model}</model></world></sdf>'
    assert "<freejoint/>" in twinform.convert(world.encode(), to="mjcf").text
