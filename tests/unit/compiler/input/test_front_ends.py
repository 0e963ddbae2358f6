"""Trees of large files: what is read from one that is freed on the way is the same."""

import pytest
from lxml import etree

from testbed import robots
from twinform.compiler import convert
from twinform.compiler.conversion import Conversion
from twinform.compiler.input import front_ends, loading
from twinform.compiler.input.front_ends import used_up

WARNED = """\
<robot name="r">
  <link name="a"/>
  <link name="b"><inertial><mass value="0"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="9"/></inertial></link>
  <joint name="j" type="revolute">
    <parent link="a"/><child link="b"/>
    <limit effort="1" velocity="1"/>
  </joint>
  <gazebo><static>true</static></gazebo>
  <gazebo reference="b"><odd/></gazebo>
</robot>
"""
WORLD = """\
<sdf version="1.9">
  <world name="w">
    <model name="m">
      <link name="a"><light name="s" type="spot"/></link>
      <model name="n"><link name="b"/><frame name="f"/></model>
    </model>
    <plugin name="p" filename="f"/>
  </world>
</sdf>
"""


def seen(made: Conversion) -> tuple[object, ...]:
    return made.text, made.diagnostics, made.ledger, made.document


@pytest.mark.parametrize("text", [robots.urdf(20), WARNED])
def test_what_is_read_is_the_same(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    usual = convert(text.encode(), to="sdf")
    back = convert(usual.text.encode(), to="urdf")
    monkeypatch.setattr(loading, "LARGE", 0)
    monkeypatch.setattr(front_ends, "_MANY", 2)
    assert seen(convert(text.encode(), to="sdf")) == seen(usual)
    assert seen(convert(usual.text.encode(), to="urdf")) == seen(back)


def test_models_in_worlds_are_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    usual = convert(WORLD.encode(), to="sdf", sdf_version="1.11")
    monkeypatch.setattr(loading, "LARGE", 0)
    assert seen(convert(WORLD.encode(), to="sdf", sdf_version="1.11")) == seen(usual)


def test_the_source_is_parsed_once_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(loading, "LARGE", 0)
    made = convert(WARNED.encode(), to="sdf")
    source = made.source
    assert source is not None
    assert made.source is source
    assert [child.tag for child in source] == ["link", "link", "joint", "gazebo", "gazebo"]


def test_links_and_joints_are_freed_once_they_are_read() -> None:
    root = etree.fromstring(WARNED)
    names = [child.get("name") for child in used_up(root)]
    assert names == ["a", "b", "j", None, None]
    assert [child.tag for child in root] == ["gazebo", "gazebo"]
