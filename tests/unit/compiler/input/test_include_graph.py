"""The outlines of files of xacro and MJCF, and which of them are only parts of others."""

from pathlib import Path

import pytest

from twinform.compiler.input.include_graph import UNKNOWN, IncludeGraph, Mention, outline
from twinform.compiler.resolve_uris import SearchPath

_HEAD = b'<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'


def test_values_are_what_xml_says() -> None:
    found = outline(_HEAD + b'\n<xacro:include\n filename="a &amp; b.xacro"/><xacro:arg name="x&#45;y"/></robot>')
    assert found.includes == (Mention("a & b.xacro", 2),)
    assert found.arguments == {"x-y": None}


def test_what_is_asked_for_in_comments_does_not_count() -> None:
    found = outline(_HEAD + b"<!-- $(arg old) -->\n<a b='$(arg\tnew) $(find here)'/></robot>")
    assert found.asked == (Mention("new", 2),)
    assert found.packages == (Mention("here", 2),)


@pytest.mark.parametrize("text", [b"<!DOCTYPE robot>" + _HEAD + b"</robot>", _HEAD, b"\xff<robot/>", b""])
def test_what_has_no_outline_is_taken_for_a_robot(text: bytes) -> None:
    assert outline(text) == UNKNOWN


@pytest.mark.parametrize(
    ("inside", "is_robot"),
    [
        (b'<link name="a"/>', True),
        (b'<xacro:include filename="arm.xacro"/>', True),
        (b'<xacro:macro name="m"><link name="a"/></xacro:macro>', False),
        (b'<xacro:include filename="arm.xacro"/><xacro:macro name="m"/>', False),
        (b'<material name="red"/>', False),
        (b"<xacro:arm/>", True),
    ],
)
def test_a_robot_has_parts_or_puts_files_together(inside: bytes, is_robot: bool) -> None:
    assert outline(_HEAD + inside + b"</robot>").is_robot is is_robot


@pytest.mark.parametrize(
    ("text", "is_robot"),
    [
        (b"<mujoco><worldbody/></mujoco>", True),
        (b'<mujoco><include file="arm.xml"/></mujoco>', True),
        (b"<mujoco><asset/></mujoco>", False),
        (b'<mujoco><body name="a"/></mujoco>', False),
        (b"<mujocoinclude><worldbody/></mujocoinclude>", False),
    ],
)
def test_mjcf_with_bodies_or_includes_is_a_robot(text: bytes, is_robot: bool) -> None:
    assert outline(text).is_robot is is_robot


def test_what_files_of_mjcf_include_is_a_part(tmp_path: Path) -> None:
    texts = {
        "scene.xml": '<mujoco><include file="parts/arm.xml"/><worldbody/></mujoco>',
        "parts/arm.xml": '<mujoco><include file="parts/hand.xml"/><worldbody/></mujoco>',  # from the main file on
        "parts/hand.xml": '<mujoco><worldbody/><include file="hand.xml"/></mujoco>',
        "alone.xml": "<mujoco><worldbody/></mujoco>",
    }
    (tmp_path / "parts").mkdir()
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    roles = IncludeGraph(SearchPath.of(())).roles(str(tmp_path / name) for name in texts)
    assert list(roles.values()) == ["robot", "part", "part", "robot"]
