"""Rules: unbridged-topic."""

import json
from pathlib import Path

import pytest
import yaml

import twinform
from tests.snippets import INERTIAL
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes.plugins.bridge_config import Bridge, BridgeConfig, bridge_yaml, bridges
from twinform.passes.plugins.catalog import system, systems
from twinform.passes.plugins.topics import topics_of

MODEL = """<model name="{name}"><link name="base">{sensors}</link><link name="leg"/>
<joint name="hip" type="revolute"><parent>base</parent><child>leg</child><axis><xyz>0 0 1</xyz></axis></joint>
{plugins}</model>"""


def model(sensors: str = "", plugins: str = "", name: str = "r") -> str:
    return MODEL.format(name=name, sensors=sensors, plugins=plugins)


def alone(sensors: str = "", plugins: str = "") -> Document:
    return twinform.loads(f'<sdf version="1.11">{model(sensors, plugins)}</sdf>')


def in_world(*models: str) -> Document:
    return twinform.loads(f'<sdf version="1.11"><world name="w">{"".join(models)}</world></sdf>')


def plugin(name: str, content: str = "") -> str:
    kind = system(name)
    return f'<plugin filename="{kind.file}" name="{kind.class_name}">{content}</plugin>'


def rows(document: Document, release: str = "harmonic", world: str | None = None) -> list[tuple[str, ...]]:
    made = bridges(document, release, DiagnosticSink(), world)
    return [(each.ros_topic_name, each.gz_topic_name, each.gz_type_name, each.direction) for each in made][1:]


def topics(document: Document, release: str, world: str | None = None) -> dict[str, str]:
    return {each.name: each.message for each in topics_of(document, release, world)}


HIP = "<joint_name>hip</joint_name>"
SEPARATE = """<sensor name="s" type="camera"><topic>i</topic>
<camera><camera_info_topic>c</camera_info_topic></camera></sensor>"""
CASES: dict[str, tuple[str, str, list[tuple[str, str, str]]]] = {
    "a sensor with a topic": ('<sensor name="s" type="imu"><topic>imu</topic></sensor>', "", [("imu", "/imu", "<")]),
    "a lidar publishes rays and points": (
        '<sensor name="s" type="gpu_lidar"><topic>/front/scan</topic></sensor>',
        "",
        [("front/scan", "/front/scan", "<"), ("front/scan/points", "/front/scan/points", "<")],
    ),
    "a lidar whose topic names a cloud gives the cloud that name": (
        '<sensor name="s" type="gpu_lidar"><topic>/velodyne_points</topic></sensor>',
        "",
        [
            ("velodyne_points/scan", "/velodyne_points", "<"),
            ("velodyne_points", "/velodyne_points/points", "<"),
        ],
    ),
    "so does a depth camera": (
        '<sensor name="s" type="depth_camera"><topic>eye/PointCloud</topic></sensor>',
        "",
        [
            ("eye/PointCloud/depth_image", "/eye/PointCloud", "<"),
            ("eye/PointCloud", "/eye/PointCloud/points", "<"),
            ("eye/camera_info", "/eye/camera_info", "<"),
        ],
    ),
    "what publishes no cloud keeps its name": (
        '<sensor name="s" type="imu"><topic>points</topic></sensor>',
        "",
        [("points", "/points", "<")],
    ),
    "a cloud's name above does not count": (
        '<sensor name="s" type="gpu_lidar"><topic>cloud/scan</topic></sensor>',
        "",
        [("cloud/scan", "/cloud/scan", "<"), ("cloud/scan/points", "/cloud/scan/points", "<")],
    ),
    "breadcrumbs whose topic is known": (
        "",
        plugin("breadcrumbs", "<topic>drop</topic>"),
        [("drop", "/drop", ">"), ("drop/remaining", "/drop/remaining", "<")],
    ),
    "breadcrumbs without": ("", plugin("breadcrumbs"), []),
    "breadcrumbs that have a name": (
        "",
        plugin("breadcrumbs", "<breadcrumb><sdf version='1.6'><model name='b'/></sdf></breadcrumb>"),
        [
            ("breadcrumbs/b/deploy", "/model/r/breadcrumbs/b/deploy", ">"),
            ("breadcrumbs/b/deploy/remaining", "/model/r/breadcrumbs/b/deploy/remaining", "<"),
        ],
    ),
    "a battery that is charged by topic": (
        "",
        plugin(
            "linear-battery",
            "<battery_name>b</battery_name><enable_recharge>1</enable_recharge>"
            "<charging_time>1</charging_time><recharge_by_topic>true</recharge_by_topic>",
        ),
        [
            ("battery/b/state", "/model/r/battery/b/state", "<"),
            ("battery/b/recharge/start", "/model/r/battery/b/recharge/start", ">"),
            ("battery/b/recharge/stop", "/model/r/battery/b/recharge/stop", ">"),
        ],
    ),
    "camera info stands beside the image": (
        '<sensor name="s" type="camera"><topic>eye/image</topic></sensor>',
        "",
        [("eye/image", "/eye/image", "<"), ("eye/camera_info", "/eye/camera_info", "<")],
    ),
    "camera info where the sensor puts it": (
        SEPARATE,
        "",
        [("i", "/i", "<"), ("c", "/c", "<")],
    ),
    "a contact's own topic": (
        '<sensor name="s" type="contact"><contact><collision>c</collision><topic>bump</topic></contact></sensor>',
        "",
        [("bump", "/bump", "<")],
    ),
    "a contact's topic outside, which Gazebo does not read": (
        '<sensor name="s" type="contact"><topic>b</topic><contact><collision>c</collision></contact></sensor>',
        "",
        [],
    ),
    "the usual topics of a drive": (
        "",
        plugin("diff-drive"),
        [
            ("cmd_vel", "/model/r/cmd_vel", ">"),
            ("odom", "/model/r/odometry", "<"),
            ("/tf", "/model/r/tf", "<"),
            ("enable", "/model/r/enable", ">"),
        ],
    ),
    "the topics that a drive is given": (
        "",
        plugin("mecanum-drive", "<topic>go</topic><odom_topic>where</odom_topic><tf_topic>/tf</tf_topic>"),
        [("go", "/go", ">"), ("where", "/where", "<"), ("/tf", "/tf", "<")],
    ),
    "transforms that are not for the tree of ROS": (
        "",
        plugin("odometry-publisher", "<odom_topic>truth</odom_topic><tf_topic>truth/transform</tf_topic>"),
        [
            ("truth", "/truth", "<"),
            ("odometry_with_covariance", "/model/r/odometry_with_covariance", "<"),
            ("truth/transform", "/truth/transform", "<"),
        ],
    ),
    "a steering that takes actuators": (
        "",
        plugin("ackermann-steering", "<use_actuator_msg>1</use_actuator_msg><actuator_number>0</actuator_number>"),
        [("actuators", "/actuators", ">")],
    ),
    "a topic for each link": (
        "",
        plugin("velocity-control", "<link_name>leg</link_name><link_name>base</link_name>"),
        [
            ("cmd_vel", "/model/r/cmd_vel", ">"),
            ("link/leg/cmd_vel", "/model/r/link/leg/cmd_vel", ">"),
            ("link/base/cmd_vel", "/model/r/link/base/cmd_vel", ">"),
        ],
    ),
    "a motor is of its model": (
        "",
        plugin("multicopter-motor-model", "<commandSubTopic>speed</commandSubTopic>"),
        [("r/speed", "/r/speed", ">")],
    ),
    "static poses": (
        "",
        plugin("pose-publisher", "<static_publisher>true</static_publisher><topic>where</topic>"),
        [("where", "/where", "<"), ("where_static", "/where_static", "<")],
    ),
    "microphones": (
        "",
        plugin("logical-audio-sensor", "<microphone><id>1</id></microphone><microphone><id>2</id></microphone>"),
        [(f"sensor/mic_{n}/detection", f"/model/r/sensor/mic_{n}/detection", "<") for n in (1, 2)],
    ),
    "a depth camera does not read where its info is to go": (
        SEPARATE.replace('"camera"', '"depth_camera"'),
        "",
        [("i", "/i", "<"), ("i/points", "/i/points", "<"), ("camera_info", "/camera_info", "<")],
    ),
    "an RGB-D camera does not either": (
        SEPARATE.replace('"camera"', '"rgbd_camera"'),
        "",
        [(f"i/{n}", f"/i/{n}", "<") for n in ("image", "depth_image", "points", "camera_info")],
    ),
    "names of parameters in topics": (
        "",
        plugin("joint-position-controller", HIP),
        [("joint/hip/_0/cmd_pos", "/model/r/joint/hip/0/cmd_pos", ">")],
    ),
    "an alternative topic": (
        "",
        plugin("joint-controller", f"{HIP}<sub_topic>speed</sub_topic>"),
        [("speed", "/model/r/speed", ">")],
    ),
    "another message": (
        "",
        plugin(
            "joint-controller", f"{HIP}<use_actuator_msg>true</use_actuator_msg><actuator_number>0</actuator_number>"
        ),
        [("actuators", "/actuators", ">")],
    ),
    "what is switched off": (
        "",
        plugin("ackermann-steering", "<steering_only>true</steering_only>"),
        [("steer_angle", "/model/r/steer_angle", ">")],
    ),
    "a namespace, or the model": (
        "",
        plugin("thruster", HIP),
        [
            ("joint/hip/cmd_thrust", "/model/r/joint/hip/cmd_thrust", ">"),
            ("joint/hip/ang_vel", "/model/r/joint/hip/ang_vel", "<"),
            ("joint/hip/enable_deadband", "/model/r/joint/hip/enable_deadband", ">"),
        ],
    ),
    "a plugin of somebody else": ("", '<plugin filename="mine" name="mine"/>', []),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES.keys())
def test_topics_are_bridged(case: tuple[str, str, list[tuple[str, str, str]]]) -> None:
    sensors, plugins, expected = case
    collision = '<collision name="c"><geometry><sphere><radius>1</radius></sphere></geometry></collision>'
    sensors = collision + sensors if "contact" in sensors else sensors
    directions = {"<": "GZ_TO_ROS", ">": "ROS_TO_GZ"}
    made = [(ros, gz, direction) for ros, gz, _, direction in rows(alone(sensors, plugins))]
    assert made == [(ros, gz, directions[way]) for ros, gz, way in expected]


def test_a_topic_that_contains_the_world_is_known_where_the_world_is() -> None:
    sensor = '<sensor name="s" type="imu"/>'
    name = "/world/w/model/r/link/base/sensor/s/imu"
    assert [row[:2] for row in rows(in_world(model(sensor)))] == [("s/imu", name)]
    assert [row[:2] for row in rows(alone(sensor), world="w")] == [("s/imu", name)]
    sink = DiagnosticSink()
    assert len(bridges(alone(sensor), "harmonic", sink)) == 1
    assert [(each.rule.name, str(each.severity)) for each in sink.diagnostics] == [("unbridged-topic", "warning")]


def test_a_nested_model_publishes_below_all_its_parents() -> None:
    inner = model(plugins=plugin("joint-state-publisher"), name="arm")
    outer = in_world(f'<model name="r"><link name="l"/>{inner}</model>')
    assert [row[1] for row in rows(outer)] == ["/world/w/model/r/model/arm/joint_state"]


ROBOT = f"""<robot name="my robot"><link name="base">{INERTIAL}</link><link name="mast">{INERTIAL}</link>
<link name="tip">{INERTIAL}</link><joint name="a" type="fixed"><parent link="base"/><child link="mast"/></joint>
<joint name="b" type="fixed"><parent link="mast"/><child link="tip"/></joint>{{}}</robot>"""


def robot(content: str) -> Document:
    return twinform.loads(ROBOT.format(content))


def missing(document: Document) -> list[tuple[str, str | None]]:
    sink = DiagnosticSink()
    bridges(document, "harmonic", sink, "w")
    return [(str(each.severity), each.found) for each in sink.diagnostics if each.rule.name == "unbridged-topic"]


def test_a_sensor_of_a_link_that_gazebo_lumps_publishes_below_the_link_that_stays() -> None:
    document = robot('<gazebo reference="tip"><sensor name="i" type="imu"/></gazebo>')
    topic = "/world/w/model/my_robot/link/base/sensor/i/imu"
    assert [row[:2] for row in rows(document, world="w")] == [("i/imu", topic)]


def test_a_sensor_on_a_joint_that_gazebo_lumps_has_no_topic() -> None:
    sensor = '<gazebo reference="a"><sensor name="f" type="force_torque"><topic>f</topic></sensor>{}</gazebo>'
    assert missing(robot(sensor.format(""))) == [("warning", "/f")]
    assert not missing(robot(sensor.format("<preserveFixedJoint>true</preserveFixedJoint>")))


def test_a_topic_that_gazebo_cannot_have_is_reported_and_not_bridged() -> None:
    document = robot(f"<gazebo>{plugin('diff-drive')}</gazebo>")
    names = [f"/model/my_robot/{name}" for name in ("cmd_vel", "odometry", "enable")]
    assert [row[1] for row in rows(document, world="w")] == names
    assert missing(document) == [("warning", "/model/my robot/tf")]


def test_a_plugin_that_stops_where_it_gets_no_topic_has_none_of_those_behind() -> None:
    document = alone(plugins=plugin("ackermann-steering", "<topic>~</topic>"))
    sink = DiagnosticSink()
    assert len(bridges(document, "harmonic", sink)) == 1
    assert [each.message.partition("here: ")[2] for each in sink.diagnostics] == [
        "gz-transport takes no topic '~'",
        *["gz-transport takes no topic '~', at which the plugin stops"] * 2,
    ]
    assert [row[0] for row in rows(document, "fortress")] == ["cmd_vel", "odom", "/tf"]


def test_a_word_for_the_default_topic_is_one_where_it_is_read_as_one() -> None:
    imu, contact = (
        '<sensor name="s" type="imu"><topic>{}</topic></sensor>',
        '<sensor name="s" type="contact">{}</sensor>',
    )
    above = "/world/w/model/r/link/base/sensor/s"
    assert list(topics(alone(imu.format("__default__")), "harmonic", "w")) == [f"{above}/imu"]
    assert list(topics(alone(imu.format("__default_topic__")), "harmonic", "w")) == ["/__default_topic__"]
    inner = "<contact><collision>c</collision><topic>__default_topic__</topic></contact>"
    assert list(topics(alone(contact.format(inner)), "harmonic", "w")) == [f"{above}/contact"]


def test_a_camera_that_is_triggered_reads_what_triggers_it() -> None:
    camera = '<sensor name="s" type="camera"><topic>i</topic><camera><triggered>true</triggered>{}</camera></sensor>'
    assert rows(alone(camera.format("")))[-1] == ("i/trigger", "/i/trigger", "gz.msgs.Boolean", "ROS_TO_GZ")
    named = alone(camera.format("<trigger_topic>shoot</trigger_topic>"))
    assert rows(named, "fortress")[-1] == ("shoot", "/shoot", "ignition.msgs.Boolean", "ROS_TO_GZ")
    sink = DiagnosticSink()
    assert len(bridges(alone(camera.format("")), "fortress", sink)) == 1
    assert {each.message.partition("here: ")[2] for each in sink.diagnostics} == {
        "it needs a <trigger_topic> for its <triggered>"
    }


def test_boxes_have_another_message_in_space() -> None:
    sensor = (
        '<sensor name="s" type="boundingbox_camera"><topic>b</topic><camera><box_type>{}</box_type></camera></sensor>'
    )
    assert rows(alone(sensor.format("2d")))[0][2] == "gz.msgs.AnnotatedAxisAligned2DBox_V"
    assert rows(alone(sensor.format("3d")))[0][2] == "gz.msgs.AnnotatedOriented3DBox_V"


def test_a_release_has_the_topics_that_it_knows() -> None:
    [row] = rows(alone(plugins=plugin("thruster", HIP)), "fortress")
    assert row[1] == "/model/r/joint/hip/cmd_thrust"


def test_a_message_that_ros_does_not_know_is_reported() -> None:
    sink = DiagnosticSink()
    bridges(alone('<sensor name="s" type="air_speed"><topic>a</topic></sensor>'), "harmonic", sink)
    assert [(each.rule.name, str(each.severity)) for each in sink.diagnostics] == [("unbridged-topic", "info")]


def test_several_models_have_topics_of_their_own() -> None:
    two = in_world(model(plugins=plugin("velocity-control")), model(plugins=plugin("velocity-control"), name="s"))
    assert [row[:2] for row in rows(two)] == [("r/cmd_vel", "/model/r/cmd_vel"), ("s/cmd_vel", "/model/s/cmd_vel")]


def test_one_name_for_two_topics_is_written_in_full() -> None:
    both = plugin("diff-drive") + plugin("velocity-control", "<topic>/other/cmd_vel</topic>")
    two = plugin("velocity-control", "<topic>/model/r/a/cmd_vel</topic>") + plugin(
        "mecanum-drive", "<topic>/a/cmd_vel</topic>"
    )
    names = [row[0] for row in rows(alone(plugins=both + two))]
    assert len({name for name in names if name != "/tf"}) == len([name for name in names if name != "/tf"])


def test_fortress_calls_messages_by_the_name_of_ignition() -> None:
    assert rows(alone(plugins=plugin("velocity-control")), "fortress")[0][2] == "ignition.msgs.Twist"


def test_the_clock_comes_first() -> None:
    assert bridges(alone(), "harmonic", DiagnosticSink())[0].ros_type_name == "rosgraph_msgs/msg/Clock"


def test_names_are_what_ros_takes() -> None:
    document = alone('<sensor name="s" type="imu"><topic>front-imu/2nd/daten_ä</topic></sensor>')
    assert [row[0] for row in rows(document)] == ["front_imu/_2nd/daten__"]


def test_the_text_is_yaml() -> None:
    text = bridge_yaml([Bridge('a"b', "/ä", "x", "y", "GZ_TO_ROS")])
    lines = [line.strip(" -") for line in text.splitlines()[1:]]
    values = dict(line.split(": ", 1) for line in lines)
    assert json.loads(values["ros_topic_name"]) == 'a"b'
    assert json.loads(values["gz_topic_name"]) == "/ä"
    assert values["direction"] == "GZ_TO_ROS"


def test_the_pass_makes_the_text_and_writes_and_changes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    document, sink = alone(plugins=plugin("diff-drive")), DiagnosticSink()
    assert BridgeConfig(file="config/bridge.yaml").run(document, sink) is document
    assert [each.path for each in sink.side_files] == ["config/bridge.yaml"]
    assert str(sink.side_files[0].content).count("ros_topic_name") == 5
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize("release", ["fortress", "harmonic", "jetty"])
def test_the_topics_of_all_systems_can_be_written(release: str) -> None:
    for kind in systems().values():
        for each in bridges(alone(plugins=plugin(kind.name)), release, DiagnosticSink(), "w"):
            assert "{" not in each.gz_topic_name
            assert "//" not in each.gz_topic_name


def test_a_topic_is_there_in_the_releases_that_have_it() -> None:
    camera = '<sensor name="s" type="logical_camera"><topic>logic</topic></sensor>'
    assert topics(alone(camera), "harmonic") == {"/logic": "gz.msgs.LogicalCameraImage"}
    assert topics(alone(camera), "ionic").keys() == {"/logic", "/logic/frustum"}
    speed = alone('<sensor name="s" type="air_speed"><topic>v</topic></sensor>')
    assert topics(speed, "garden") == {"/v": "gz.msgs.AirSpeedSensor"}
    assert topics(speed, "jetty") == {"/v": "gz.msgs.AirSpeed"}
    track = alone(plugins=plugin("track-controller", "<link>base</link>"))
    assert "/model/r/link/base/odometry" not in topics(track, "fortress")
    assert "/model/r/link/base/odometry" in topics(track, "garden")


def test_a_doppler_log_publishes_below_its_name() -> None:
    sensor = '<sensor name="s" type="custom" gz:type="dvl"/>'
    assert list(topics(alone(sensor), "harmonic", "w")) == ["/world/w/model/r/link/base/sensor/s/dvl/velocity"]
    assert not topics(alone(sensor), "garden", "w")


def test_a_topic_may_have_any_character() -> None:
    document = alone('<sensor name="s" type="imu"><topic>\U0001f916 "\u540d"</topic></sensor>')
    read = yaml.safe_load(bridge_yaml(bridges(document, "harmonic", DiagnosticSink())))
    assert read[1]["gz_topic_name"] == '/\U0001f916_"\u540d"'
