"""The example robot for Gazebo Classic runs in gz-sim with the world and the bridge that are made for it."""

import re
from pathlib import Path

from click.testing import CliRunner

import twinform
from twinform.cli import main
from twinform.diagnostics import DiagnosticSink, Severity
from twinform.passes import parse_pipeline
from twinform.passes.plugins.bridge_config import bridges
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
    sink = DiagnosticSink()
    CheckPlugins().run(twinform.load(world), sink)
    assert not [each for each in sink.diagnostics if each.severity >= Severity.WARNING]


def test_the_migrated_robot_is_the_same_robot() -> None:
    migrated = twinform.convert(ROVER, to="urdf", passes=MIGRATE).text
    found = twinform.diff(ROVER, migrated.encode())
    about = re.compile(r"(sensor|plugin|ros2_control|transmission) ")
    assert [each.message for each in found.differences if not about.match(each.aspect)] == []


CLOUDS = """<robot name="r"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><gazebo reference="base">
<sensor name="v" type="ray"><plugin name="p" filename="libgazebo_ros_velodyne_laser.so"><topicName>/velodyne_points
</topicName></plugin></sensor><sensor name="w" type="ray"><plugin name="q" filename="libgazebo_ros_ray_sensor.so">
<ros><remapping>~/out:=cloud_in</remapping></ros></plugin></sensor></gazebo></robot>"""


def test_clouds_keep_the_names_that_they_had_in_ros() -> None:
    document = twinform.loads(CLOUDS)
    migrated = parse_pipeline("migrate-gazebo-classic").run(document, DiagnosticSink())
    found = {each.ros_topic_name: each.ros_type_name for each in bridges(migrated, "harmonic", DiagnosticSink())}
    cloud, scan = "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/LaserScan"
    assert {name: type_ for name, type_ in found.items() if name != "/clock"} == {
        "velodyne_points": cloud,
        "velodyne_points/scan": scan,
        "cloud_in": cloud,
        "cloud_in/scan": scan,
    }


def test_a_world_gets_what_its_plugins_need() -> None:
    text = """<sdf version="1.6"><world name="sea"><model name="boat"><link name="hull"/><plugin name="h"
    filename="gz-sim-hydrodynamics-system"><link_name>hull</link_name></plugin></model></world></sdf>"""
    sink = DiagnosticSink()
    made = parse_pipeline("migrate-gazebo-classic").run(twinform.loads(text), sink)
    names = [(each.name or "").rpartition("::")[2] for each in made.worlds[0].plugins]
    assert names == ["Physics", "UserCommands", "SceneBroadcaster", "Buoyancy"]
    assert "added-world-system" in {each.rule.name for each in sink.diagnostics}
