"""Robots of other people, from their xacro to a package that every judge likes; checkouts of them are not here.

`TWINFORM_CHECKOUTS` is a folder with them, by the names of their repositories.
"""

import os
from dataclasses import dataclass
from pathlib import Path

import pytest
from click.testing import CliRunner

from testbed.packages.judges import Packaged
from testbed.packages.public_robots import Robot
from testbed.packages.ros2_judges import JUDGES
from twinform.cli import main

_FOLDER = os.environ.get("TWINFORM_CHECKOUTS")


@dataclass(frozen=True, slots=True)
class _Public:
    """A xacro in a repository, its arguments, and a mesh without which the checkout is not whole."""

    xacro: str
    arguments: tuple[str, ...]
    mesh: str


_ROBOTS = {
    "ur5e": _Public(
        "Universal_Robots_ROS2_Description/urdf/ur.urdf.xacro",
        ("name:=ur", "ur_type:=ur5e"),
        "Universal_Robots_ROS2_Description/meshes/ur5e/visual/base.dae",
    ),
    "burger": _Public(
        "turtlebot3/turtlebot3_description/urdf/turtlebot3_burger.urdf",
        ("namespace:=", "--xacro"),
        "turtlebot3/turtlebot3_description/meshes/bases/burger_base.stl",
    ),
}


@pytest.mark.parametrize("name", _ROBOTS)
def test_a_xacro_becomes_a_package(name: str, tmp_path: Path) -> None:
    robot = _ROBOTS[name]
    if not _FOLDER or not (Path(_FOLDER) / robot.mesh).is_file():
        pytest.skip(f"TWINFORM_CHECKOUTS is no folder with {robot.mesh}")
    folder = tmp_path / name
    said = ("--description", "A robot", "--maintainer", "Ann Onym", "--email", "ann@example.org")
    words = ("package", str(Path(_FOLDER) / robot.xacro), *robot.arguments, "-o", str(folder), "--kind", "both", *said)
    done = CliRunner().invoke(main, [*words, "--license", "BSD-3-Clause"])
    assert done.exit_code == 0, done.output
    packaged = Packaged(Robot(name, folder / "urdf" / f"{name}.urdf"), folder)
    told = {judge.name: judge.judged(packaged) for judge in JUDGES if not judge.missing()}
    assert {judge: why for judge, why in told.items() if why} == {}
    assert "catkin_pkg" in told
