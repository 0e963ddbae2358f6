"""Plugins for ROS 2 are migrated by what they read, without parameters of ROS 1, and remappings are those of rcl."""

import pytest

import twinform
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Element, Plugin
from twinform.passes.classic.migrate_gazebo_classic import MigrateGazeboClassic
from twinform.passes.classic.systems import RosNames
from twinform.passes.classic.tables import migration_of
from twinform.passes.plugins.catalog import classic_plugins, classic_plugins_of_file

BOTH = {
    kind.file: {row.name for row in classic_plugins_of_file(kind.file)["noetic"].parameters} - names
    for kind in classic_plugins("ros2").values()
    if (names := {row.name for row in kind.parameters}) and "noetic" in classic_plugins_of_file(kind.file)
}
"""Files that are there for both, with the parameters that only ROS 1 reads."""
WORLD = """<sdf version="1.6"><world name="w"><model name="r"><link name="base">{}</link>
<link name="leg"/><joint name="j" type="revolute"><parent>base</parent><child>leg</child><axis><xyz>0 0 1</xyz></axis>
</joint>{}</model></world></sdf>"""
USUAL = "<joint_name>j</joint_name><body_name>base</body_name><link_name>base</link_name>"
SENSORS = {"bumper": "contact", "camera": "camera", "imu_sensor": "imu"}


def migrated(file: str, parameters: str) -> twinform.Document:
    plugin = f'<plugin name="p" filename="{file}"><ros><namespace>n</namespace></ros>{USUAL}{parameters}</plugin>'
    type_ = next((type_ for word, type_ in SENSORS.items() if word in file), None)
    sensor = f'<sensor name="s" type="{type_}">{plugin}</sensor>'
    document = twinform.loads(WORLD.format(sensor, "") if type_ else WORLD.format("", plugin))
    return MigrateGazeboClassic().run(document, DiagnosticSink())


@pytest.mark.parametrize("file", BOTH)
def test_what_only_ros_1_reads_changes_nothing(file: str) -> None:
    others = "".join(f"<{name}>7</{name}>" for name in sorted(BOTH[file]))
    assert migrated(file, others) == migrated(file, "")


def test_there_are_files_for_both() -> None:
    assert sum(map(bool, BOTH.values())) > 10


RULES: dict[str, tuple[list[str], str, str]] = {
    "nothing": ([], "n/p/out", "n/cmd_vel"),
    "private": (["~/out:=data"], "n/data", "n/cmd_vel"),
    "to private": (["cmd_vel:=~/go"], "n/p/out", "n/p/go"),
    "absolute": (["/n/p/out:=/data", "cmd_vel:=/go"], "data", "go"),
    "another level": (["out:=data", "p/cmd_vel:=go", "/cmd_vel:=go"], "n/p/out", "n/cmd_vel"),
    "the first counts": (["~/out:=a", "~/out:=b"], "n/a", "n/cmd_vel"),
    "of a node": (["p:cmd_vel:=go", "q:~/out:=data"], "n/p/out", "n/go"),
    "a topic by its scheme": (["rostopic://cmd_vel:=go"], "n/p/out", "n/go"),
    "the node itself": (["__node:=q", "__ns:=/m"], "m/q/out", "m/cmd_vel"),
}


@pytest.mark.parametrize("case", RULES.values(), ids=RULES)
def test_remappings_are_about_whole_names(case: tuple[list[str], str, str]) -> None:
    rules, out, command = case
    children = tuple(Element(name="remapping", text=rule) for rule in rules)
    ros = Element(name="ros", children=(Element(name="namespace", text="n"), *children))
    names = RosNames(Plugin(name="p", filename="f", content=(ros,)))
    assert [names.topic("{=$plugin/out}"), names.topic("{commandTopic|=cmd_vel}")] == [out, command]


@pytest.mark.parametrize("file", ["libgazebo_motor_model.so", "librotors_gazebo_motor_model.so"])
def test_motors_of_px4_and_rotors_are_in_gz_sim(file: str) -> None:
    migration = migration_of(file)
    assert migration is not None
    assert [row.system for row in migration.systems] == ["multicopter-motor-model"]
