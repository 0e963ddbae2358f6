"""Packages of xacro files: where `$(find)` leads, and where findings of a conversion were written."""

from pathlib import Path

import pytest

import twinform
from tests.write_files import write_files

pytest.importorskip("xacro")

HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">'
FILES = {
    "arm-ros2/package.xml": "<package><name>arm</name></package>",
    "arm-ros2/urdf/arm.urdf.xacro": HEAD
    + """
<xacro:include filename="$(find arm)/urdf/tip.xacro"/>
<xacro:include filename="$(find wheels)/urdf/wheel.xacro"/>
<link name="base"/>
<xacro:wheel name="left"/>
<xacro:tip/>
</robot>""",
    "arm-ros2/urdf/tip.xacro": HEAD
    + """

<xacro:macro name="tip"><link name="tip"/>
<joint name="tip" type="fixed"><parent link="base"/><child link="tip"/></joint></xacro:macro></robot>""",
    "wheels-2.0/package.xml": "<package><name>wheels</name></package>",
    "wheels-2.0/urdf/wheel.xacro": HEAD
    + """
<xacro:macro name="wheel" params="name">
<link name="${name}"><collision><geometry><sphere radius="1"/></geometry></collision></link>
<joint name="${name}_joint" type="continuous"><parent link="base"/><child link="${name}"/></joint>

<gazebo reference="${name}"><material>Gazebo/Blue</material></gazebo></xacro:macro></robot>""",
}


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """Two packages beside each other, in folders that are called otherwise."""
    write_files(tmp_path / "ws", FILES)
    return tmp_path / "ws"


@pytest.mark.parametrize("start", [".", "..", "arm-ros2", "arm-ros2/urdf"])
def test_packages_are_found_from_every_folder(workspace: Path, start: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(workspace / start)
    path = {".": "arm-ros2/urdf", "..": "ws/arm-ros2/urdf", "arm-ros2": "urdf", "arm-ros2/urdf": ""}[start]
    document = twinform.load(Path(path) / "arm.urdf.xacro")
    assert [link.name for link in document.models[0].links] == ["base", "left", "tip"]


def test_what_a_conversion_finds_is_where_it_was_written(workspace: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(workspace)
    made = twinform.convert("arm-ros2/urdf/arm.urdf.xacro", to="sdf")
    tip, wheel = (workspace / "arm-ros2/urdf/tip.xacro", workspace / "wheels-2.0/urdf/wheel.xacro")
    found = {(each.rule.name, Path(each.location.file).absolute(), each.location.line) for each in made.diagnostics}
    assert {("renamed", tip, 4), ("massless-link", wheel, 3), ("gazebo-tag-without-target", wheel, 6)} <= found
    entries = {
        (each.rule.name, Path(each.location.file).absolute(), each.location.line) for each in made.ledger.entries
    }
    assert {("renamed", tip, 4), ("gazebo-tag-without-target", wheel, 6)} <= entries
    assert not [each for each in (*found, *entries) if "(expanded)" in str(each[1])]


def test_a_package_that_is_nowhere_is_an_error(workspace: Path) -> None:
    path = workspace / "arm-ros2/urdf/arm.urdf.xacro"
    path.write_text(HEAD + '<xacro:include filename="$(find legs)/a.xacro"/></robot>')
    assert [each.rule.name for each in twinform.check(path).diagnostics] == ["missing-package"]


VISUAL = "<visual><geometry><sphere radius='1'/></geometry></visual>\n"
SENSOR = """<gazebo reference="${name}">
<sensor name="s" type="camera">

<wrong/><camera/></sensor></gazebo></xacro:macro>"""


@pytest.fixture
def wheel(workspace: Path) -> Path:
    """The macro of the wheel with a visual and a sensor in it that has an unknown element on line 10."""
    path = workspace / "wheels-2.0/urdf/wheel.xacro"
    text = path.read_text().replace("<collision>", f"{VISUAL}<collision>")
    path.write_text(text.replace("</xacro:macro>", SENSOR))
    return path


def test_what_is_wrong_in_gazebo_elements_is_reported_once_and_where_it_was_written(
    workspace: Path, wheel: Path
) -> None:
    made = twinform.convert(workspace / "arm-ros2/urdf/arm.urdf.xacro", to="sdf")
    found = [each.location for each in made.diagnostics if each.rule.name == "unknown-element"]
    assert [(Path(each.file), each.line) for each in found] == [(wheel, 10)]


@pytest.mark.usefixtures("wheel")
def test_an_expansion_becomes_what_its_text_becomes(workspace: Path) -> None:
    path = workspace / "arm-ros2/urdf/arm.urdf.xacro"
    text = twinform.convert(path, to="urdf").text
    assert twinform.convert(path, to="sdf").text == twinform.convert(text.encode(), to="sdf").text
