"""The example robot for Gazebo Classic runs in gz-sim with the world and the bridge that are made for it."""

import re
from pathlib import Path

from click.testing import CliRunner

import twinform
from twinform.cli import main
from twinform.diagnostics import Notes, Severity
from twinform.passes.plugins.check_plugins import CheckPlugins

ROVER = Path(__file__).parents[4] / "examples/classic_rover.urdf"
MIGRATE = "migrate-gazebo-classic{controllers=rover.yaml}"
TOPICS = {"/clock", "/tf", "cmd_vel", "enable", "front/camera_info", "front/image_raw", "odom", "scan", "scan/points"}


def test_the_migrated_robot_has_its_world_and_the_topics_that_it_had_in_ros(tmp_path: Path) -> None:
    robot, world, bridge = (tmp_path / name for name in ("robot.sdf", "world.sdf", "bridge.yaml"))
    options = ["--passes", MIGRATE, "-o", str(robot), "--world", str(world), "--bridge", str(bridge)]
    done = CliRunner().invoke(main, ["convert", str(ROVER), "--to", "sdf", *options], catch_exceptions=False)
    assert done.exit_code == 0
    assert set(re.findall(r'ros_topic_name: "(.*)"', bridge.read_text())) == TOPICS
    notes = Notes()
    CheckPlugins().run(twinform.load(world), notes)
    assert not [each for each in notes.diagnostics if each.severity >= Severity.WARNING]


def test_the_migrated_robot_is_the_same_robot() -> None:
    migrated = twinform.convert(ROVER, to="urdf", passes=MIGRATE).text
    found = twinform.diff(ROVER, migrated.encode())
    about = re.compile(r"(sensor|plugin|ros2_control|transmission) ")
    assert [each.message for each in found.differences if not about.match(each.aspect)] == []
