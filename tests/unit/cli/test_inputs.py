from pathlib import Path

import pytest

from tests.unit.cli.conftest import Run
from twinform.cli.inputs import InputSource

ROBOT = """\
<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">
  <xacro:arg name="side" default="left"/>
  <link name="$(arg side)"/>
</robot>
"""


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    path = tmp_path / "robot.urdf.xacro"
    path.write_text(ROBOT)
    return path


def test_arguments_of_xacro_follow_the_inputs(run: Run, robot: Path) -> None:
    done = run("convert", robot, "side:=right", "--to", "urdf")
    assert done.exit_code == 0
    assert '<link name="right"/>' in done.stdout


def test_a_xacro_file_becomes_the_other_format_under_its_own_name(run: Run, robot: Path) -> None:
    assert run("convert", robot, "-o", f"{robot.parent}/out/").exit_code == 0
    assert (robot.parent / "out/robot.sdf").exists()


def test_check_takes_arguments_and_warns_of_unused_ones(run: Run, robot: Path) -> None:
    assert run("check", robot, "side:=right").exit_code == 0
    assert "unused-argument" in run("check", robot, "sid:=right").stdout


def test_no_xacro_refuses_it(run: Run, robot: Path) -> None:
    done = run("check", "--no-xacro", robot)
    assert done.exit_code == 1
    assert "xacro-refused" in done.stdout


def test_arguments_without_a_xacro_file_are_wrong_usage(run: Run, folder: Path) -> None:
    done = run("check", folder / "good.urdf", "side:=right")
    assert done.exit_code == 2
    assert "no input is a .xacro file" in done.stderr
    assert run("check", "side:=right").exit_code == 2


def test_a_folder_for_uris_must_be_there(run: Run, robot: Path) -> None:
    assert run("check", "--path", robot.parent / "none", robot).exit_code == 2
    assert run("check", "--path", robot.parent, robot).exit_code == 0


@pytest.mark.parametrize("source", ["good.urdf", "-"])
def test_limits_are_lifted_by_options(run: Run, folder: Path, source: str) -> None:
    text = (folder / "good.urdf").read_text()
    argument = "-" if source == "-" else folder / source
    for option, least in (("--max-size", len(text.encode())), ("--max-tags", text.count("<"))):
        assert run("check", argument, option, str(least), text=text).exit_code == 0
        done = run("check", argument, option, str(least - 1), text=text)
        assert done.exit_code == 1
        assert f"give a larger {option}" in done.stdout


@pytest.mark.parametrize(
    "option", ["--max-size=0", "--max-size=-1", "--max-size=many", "--max-size=", "--max-tags=0", "--max-tags=2MB"]
)
def test_limits_that_mean_nothing_are_wrong_usage(run: Run, folder: Path, option: str) -> None:
    done = run("check", folder / "good.urdf", option)
    assert done.exit_code == 2
    assert option.partition("=")[0] in done.stderr


CASES = [
    (b"<robot name='a'/>", "urdf"),
    (b"\xef\xbb\xbf<?xml version='1.0'?>\n<!-- <sdf> -->\n<robot>", "urdf"),
    (b"<!DOCTYPE x><sdf version='1.6'>", "sdf"),
    (b"<sdf\nversion='1.6'>", "sdf"),
    (b"<sdf/>", "sdf"),
    (b" {}", "json"),
    (b"<mujoco/>", "mjcf"),
    (b"<mujocoinclude/>", None),
    (b"<!-- no end <robot>", None),
    (b"<!--" * 20000, None),
    (b"<", None),
    (b"", None),
]


@pytest.mark.parametrize(("text", "format_"), CASES)
def test_format_is_that_of_the_root_element(text: bytes, format_: str | None) -> None:
    assert InputSource(text, "<stdin>").format == format_


@pytest.mark.parametrize(
    ("name", "format_"),
    [("a.urdf", "urdf"), ("b.WORLD", "sdf"), ("c.json", "json"), ("d.xml", None), ("e\0.sdf", "sdf")],
)
def test_format_of_a_file_that_tells_nothing_is_that_of_its_suffix(
    name: str, format_: str | None, tmp_path: Path
) -> None:
    assert InputSource(str(tmp_path / name), name).format == format_


def test_content_counts_more_than_the_suffix(tmp_path: Path) -> None:
    file = tmp_path / "robot.sdf"
    file.write_text("<robot name='a'/>")
    assert InputSource(str(file), str(file)).format == "urdf"
