"""Robots of robot_descriptions by name: a folder stands in for the repositories, which are not fetched here."""

import sys
from pathlib import Path

import pytest

import twinform
from tests.write_files import write_files

pytest.importorskip("robot_descriptions")

_UR = """\
<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="$(arg name)">
  <xacro:arg name="name" default="ur"/>
  <xacro:arg name="ur_type" default="ur5x"/>
  <xacro:include filename="$(find ur_description)/urdf/inc/base.xacro"/>
  <link name="$(arg ur_type)_tool"/>
  <joint name="flange" type="fixed"><parent link="base_link"/><child link="$(arg ur_type)_tool"/></joint>
</robot>
"""
_BASE = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="base_link"/></robot>'
_MANIFEST = "<package format='3'><name>ur_description</name><version>1.0.0</version></package>"


@pytest.fixture(autouse=True)
def repositories(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    def clone(name: str, commit: str | None = None) -> str:
        assert commit is None
        return str(tmp_path / name)

    monkeypatch.setattr("robot_descriptions._cache.clone_to_cache", clone)
    for name in ("ur5e_description", "a1_description"):  # modules that other tests may have imported
        monkeypatch.delitem(sys.modules, f"robot_descriptions.{name}", raising=False)
    files = {
        "Universal_Robots_ROS2_Description/package.xml": _MANIFEST,
        "Universal_Robots_ROS2_Description/urdf/ur.urdf.xacro": _UR,
        "Universal_Robots_ROS2_Description/urdf/inc/base.xacro": _BASE,
        "unitree_ros/robots/a1_description/urdf/a1.urdf": '<robot name="a1"><link name="trunk"/></robot>',
    }
    return write_files(tmp_path, files)


def test_a_description_that_is_xacro_gets_its_arguments() -> None:
    robot = twinform.load_description("ur5e_description").models[0]
    assert robot.name == "ur5e"
    assert [each.name for each in robot.links] == ["base_link", "ur5e_tool"]


def test_arguments_that_are_given_go_before_those_of_the_description() -> None:
    robot = twinform.load_description("ur5e_description", arguments={"name": "mine"}).models[0]
    assert robot.name == "mine"
    assert robot.links[1].name == "ur5e_tool"


def test_a_description_that_is_urdf_is_read() -> None:
    assert twinform.load_description("a1_description").models[0].links[0].name == "trunk"


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("ur5e_descripton", "did you mean 'ur5e_description'"),
        ("ur5e_mj_description", "is not URDF"),
        ("_cache", "has no '_cache'"),
        ("loaders.yourdfpy", "has no"),
        ("", "has no ''"),
    ],
)
def test_a_name_of_none_is_refused(name: str, why: str) -> None:
    with pytest.raises(ValueError, match=why):
        twinform.load_description(name)


def test_without_the_package_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "robot_descriptions", None)
    with pytest.raises(ModuleNotFoundError, match=r"\[descriptions\]"):
        twinform.load_description("ur5e_description")
