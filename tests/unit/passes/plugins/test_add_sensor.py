"""Rules: nothing-to-add-to, missing-world-system, world-system-needed, added-world-system."""

import math
from pathlib import Path

import pytest

import twinform
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Sensor
from twinform.ir.frames import FrameGraph
from twinform.passes import PipelineError, parse_pipeline
from twinform.passes.framework.pass_base import option_name
from twinform.passes.plugins.add_elements import frames_of
from twinform.passes.plugins.add_sensor import AddSensor, addable, settings_of
from twinform.passes.plugins.catalog import sensor, sensors
from twinform.passes.plugins.check_plugins import CheckPlugins
from twinform.passes.plugins.sites import plugins_of, sensors_of
from twinform.passes.plugins.topics import topics_of

_ROOT = Path(__file__).parents[4]
WORLD = """<sdf version="1.11"><world name="w">{}<model name="r"><link name="base">
<collision name="skin"><geometry><sphere><radius>1</radius></sphere></geometry></collision></link><link name="hand"/>
<joint name="wrist" type="fixed"><parent>base</parent><child>hand</child></joint></model></world></sdf>"""
URDF = """<robot name="r">
  <link name="base"><collision><geometry><sphere radius="1"/></geometry></collision>
  <collision><geometry><sphere radius="2"/></geometry></collision></link>
  <link name="hand"><inertial><mass value="1"/>
  <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="wrist" type="fixed"><parent link="base"/><child link="hand"/></joint>
</robot>"""


def run(text: str, document: Document) -> tuple[Document, list[str]]:
    sink = DiagnosticSink()
    made = parse_pipeline(text).run(document, sink)
    return made, [each.rule.name for each in sink.diagnostics]


def pipeline(type_: str, more: str = "") -> str:
    holder = "joint=wrist" if sensor(type_).holders == ("joint",) else "link=base"
    release = "garden" if type_ == "wideanglecamera" else "harmonic"
    return f"add-sensor{{type={type_} {holder} release={release} {more}}}"


def text_of(made: Sensor, path: str) -> str | None:
    element = next(part.element for part in made.opaque if part.element and part.element.name != "gz_frame_id")
    for step in path.split("/"):
        element = element.find(step)
        assert element is not None
    return element.text


@pytest.mark.parametrize("type_", addable())
@pytest.mark.parametrize("model", [URDF, WORLD.format("")], ids=["urdf", "sdf"])
def test_every_kind_of_sensor_is_added_and_passes_the_check_of_files(type_: str, model: str) -> None:
    noise = "noise=typical" if settings_of(type_).noises else ""
    made, found = run(pipeline(type_, noise), twinform.loads(model))
    [(node, site)] = sensors_of(made)
    assert (node.type, site.holder) == (type_, "wrist" if type_ == "force_torque" else "base")
    assert set(found) <= {"world-system-needed", "added-world-system", "missing-world-system"}
    sink = DiagnosticSink()
    CheckPlugins().run(made, sink)
    assert {each.rule.name for each in sink.diagnostics} <= {"world-system-needed", "missing-world-system"}
    text = twinform.convert(model.encode(), to="sdf", sdf_version="1.11", passes=pipeline(type_, noise)).text
    warned = {each.rule.name for each in twinform.check(text.encode()).diagnostics if each.severity > 1}
    assert warned <= {"missing-world-system"}  # no pass knows where on Earth a world is


def test_every_sensor_that_gazebo_simulates_can_be_added() -> None:
    simulated = {type_ for type_, kind in sensors().items() if "harmonic" in kind.releases and kind.custom is None}
    assert set(addable()) == simulated


def test_adding_twice_is_adding_once_and_another_one_gets_another_name() -> None:
    for model in (URDF, WORLD.format("")):
        once = run(pipeline("imu"), twinform.loads(model))[0]
        assert run(pipeline("imu"), once)[0] == once
        other = run(pipeline("imu", "rate=7"), once)[0]
        assert [each.name for each, _ in sensors_of(other)] == ["imu", "imu_1"]


def test_two_sensors_never_share_a_topic() -> None:
    two = "add-sensor{type=camera link=base},add-sensor{type=camera link=hand}"
    for model in (URDF, WORLD.format("")):
        made = run(two, twinform.loads(model))[0]
        topics = [(each.name, each.topic) for each, _ in sensors_of(made)]
        assert topics == [("camera", "camera/image"), ("camera_1", "camera_1/image")]
        assert run(two, made)[0] == made


def test_the_world_of_urdf_carries_no_sensor() -> None:
    text = '<robot name="r"><link name="world"/><link name="a"/><joint name="j" type="fixed"><parent link="world"/>'
    document, sink = twinform.loads(f'{text}<child link="a"/></joint></robot>'), DiagnosticSink()
    assert parse_pipeline("add-sensor{type=imu link=world}").run(document, sink) is document
    assert [each.rule.name for each in sink.diagnostics] == ["nothing-to-add-to"]


def test_a_world_gets_what_the_sensor_needs_and_what_a_plugin_switches_off() -> None:
    made, found = run(pipeline("camera"), twinform.loads(WORLD.format("")))
    names = [(plugin.name or "").rsplit("::", 1)[-1] for plugin, _ in plugins_of(made)]
    assert names == ["Physics", "UserCommands", "SceneBroadcaster", "Sensors"]
    assert found == ["added-world-system"]
    again, found = run(pipeline("gpu_lidar"), made)
    assert len(plugins_of(again)) == len(names)
    assert not found


def test_a_world_that_has_the_system_by_its_old_name_keeps_it() -> None:
    own = '<plugin filename="libignition-gazebo-imu-system.so" name="ignition::gazebo::systems::Imu"/>'
    made, found = run(pipeline("imu"), twinform.loads(WORLD.format(own)))
    assert len(plugins_of(made)) == 1
    assert not found


def test_a_place_on_earth_is_asked_for_where_a_receiver_needs_one() -> None:
    _, found = run(pipeline("navsat"), twinform.loads(WORLD.format("")))
    assert found == ["missing-world-system", "added-world-system"]
    placed = WORLD.format("<spherical_coordinates><latitude_deg>1</latitude_deg></spherical_coordinates>")
    assert run(pipeline("navsat"), twinform.loads(placed))[1] == ["added-world-system"]


def test_for_a_file_without_a_world_it_reports_what_the_world_needs() -> None:
    sink = DiagnosticSink()
    parse_pipeline(pipeline("imu")).run(twinform.loads(URDF), sink)
    [found] = sink.diagnostics
    assert found.rule.name == "world-system-needed"
    assert '<plugin filename="gz-sim-imu-system" name="gz::sim::systems::Imu"/>' in (found.help or "")


def test_the_options_decide_what_is_written() -> None:
    more = "sensor-name=eye topic=up rate=5 xyz=[1,2,3] rpy=[0,0,1] width=80 fov=0.5 noise-stddev=0.1 frame-id=optical"
    [(made, _)] = sensors_of(run(pipeline("camera", more), twinform.loads(URDF))[0])
    assert (made.name, made.topic, made.update_rate) == ("eye", "up", 5)
    assert made.pose
    assert (made.pose.xyz, made.pose.rpy) == ((1, 2, 3), (0, 0, 1))
    wanted = {"image/width": "80", "horizontal_fov": "0.5", "noise/stddev": "0.1", "noise/type": "gaussian"}
    assert {path: text_of(made, path) for path in wanted} == wanted
    assert [part.element.text for part in made.opaque if part.element and part.element.name == "gz_frame_id"] == [
        "optical"
    ]


@pytest.mark.parametrize(("release", "word"), [("fortress", "ignition_frame_id"), ("jetty", "frame_id")])
def test_the_frame_is_written_in_the_element_of_the_release(release: str, word: str) -> None:
    document = twinform.loads('<sdf version="1.12"><model name="r"><link name="base"/></model></sdf>')
    text = f"add-sensor{{type=imu link=base frame-id=here release={release}}}"
    [(made, _)] = sensors_of(run(text, document)[0])
    found_names = {part.element.name for part in made.opaque if part.element}
    assert (made.frame_id == "here") == (word == "frame_id")
    assert (word in found_names) == (word != "frame_id")


@pytest.mark.parametrize(("more", "topic"), [("", "imu"), ("sensor-name=back", "back/imu"), ("topic=here", "here")])
def test_topics_are_short_and_of_their_own(more: str, topic: str) -> None:
    [(made, _)] = sensors_of(run(pipeline("imu", more), twinform.loads(URDF))[0])
    assert made.topic == topic


def test_a_contact_sensor_looks_at_the_collisions_by_the_names_that_gazebo_gives_them() -> None:
    [(made, _)] = sensors_of(run(pipeline("contact"), twinform.loads(URDF))[0])
    part = made.opaque[-1]
    assert part.element
    names = [each.text for each in part.element.children if each.name == "collision"]
    assert names == ["base_collision", "base_collision_1"]
    converted = twinform.convert(URDF.encode(), to="sdf", passes=pipeline("contact")).document
    assert [each.name for each in converted.models[0].links[0].collisions] == ["base_collision", "base_collision_1"]


@pytest.mark.parametrize(("more", "frame"), [("", "base"), ("frame-id=f", "f"), ("xyz=[0,0,1]", "imu_frame")])
def test_the_frame_is_that_of_the_link_or_one_of_its_own_where_the_sensor_is_elsewhere(
    more: str, frame: str | None
) -> None:
    [(made, _)] = sensors_of(run(f"add-sensor{{type=imu link=base release=jetty {more}}}", twinform.loads(URDF))[0])
    assert made.frame_id == frame


@pytest.mark.parametrize("model", ["urdf", "sdf"])
def test_the_frame_of_a_camera_looks_along_z_where_the_camera_looks(model: str) -> None:
    document = twinform.loads(URDF if model == "urdf" else WORLD.format(""))
    made = run(pipeline("camera", "xyz=[1,2,3] rpy=[0,0,1.5]"), document)[0]
    [(camera, site)] = sensors_of(made)
    assert site.model
    place = FrameGraph(site.model).pose("camera_optical_frame", "base")
    assert place.translation == pytest.approx((1, 2, 3))
    assert place.rotate((0.0, 0.0, 1.0)) == pytest.approx((math.cos(1.5), math.sin(1.5), 0))
    assert place.rotate((0.0, 1.0, 0.0)) == pytest.approx((0, 0, -1))
    assert list(frames_of(camera)) == ["camera_optical_frame"]
    sdf = twinform.convert(emit(made, DiagnosticSink()).encode(), to="sdf", sdf_version="1.11").document
    [(_, there)] = sensors_of(sdf)
    assert there.model
    assert FrameGraph(there.model).pose("camera_optical_frame", "base").translation == pytest.approx((1, 2, 3))


@pytest.mark.parametrize("type_", ["camera", "thermal_camera", "segmentation_camera", "wideanglecamera"])
def test_cameras_with_nothing_but_images_look_along_z(type_: str) -> None:
    made = run(pipeline(type_, "sensor-name=eye"), twinform.loads(URDF))[0]
    assert made.models[0].links[-1].name == "eye_optical_frame"


def test_a_frame_that_is_there_is_taken_and_a_joint_of_its_name_is_none() -> None:
    once = run(pipeline("camera"), twinform.loads(URDF.replace('"hand"', '"camera_optical_frame"')))[0]
    assert [link.name for link in once.models[0].links] == ["base", "camera_optical_frame"]
    again = run(pipeline("camera"), twinform.loads(URDF.replace('"wrist"', '"camera_optical_frame"')))[0]
    assert again.models[0].links[-1].name == "camera_optical_frame_"
    assert again.models[0].joints[-1].name == "camera_optical_frame__joint"


@pytest.mark.parametrize("more", ["", "topic=bump"])
def test_a_contact_sensor_has_its_topic_where_gazebo_reads_it(more: str) -> None:
    for model in (URDF, WORLD.format("")):
        made = run(pipeline("contact", more), twinform.loads(model))[0]
        [(node, _)] = sensors_of(made)
        assert (node.topic, text_of(node, "topic")) == (None, "bump" if more else "contact")
        assert [each.name for each in topics_of(made, "harmonic")] == ["/bump" if more else "/contact"]


def test_a_fixed_joint_that_is_measured_stays_one() -> None:
    made = run(pipeline("force_torque"), twinform.loads(URDF))[0]
    [extension] = made.models[0].extensions
    assert [each.name for each in extension.content] == ["preserveFixedJoint", "sensor"]


@pytest.mark.parametrize(
    ("text", "message", "found", "help_"),
    [
        ("{type=imu link=bas}", "there is no link 'bas' to add to", "bas", "did you mean base?"),
        ("{type=force_torque joint=rist}", "there is no joint 'rist' to add to", "rist", "did you mean wrist?"),
        ("{type=contact link=hand}", "it is not clear which collision to add to: there is none", None, None),
        ("{type=contact link=hand collision=x}", "there is no collision 'x' to add to", "x", None),
        (
            "{type=contact link=base collision=skim}",
            "there is no collision 'skim' to add to",
            "skim",
            "there are base_collision, base_collision_1",
        ),
        ("{type=imu link=base model=s}", "there is no model 's' to add to", "s", "there are r"),
    ],
)
def test_where_there_is_nothing_to_add_to_is_an_error(
    text: str, message: str, found: str | None, help_: str | None
) -> None:
    document, sink = twinform.loads(URDF), DiagnosticSink()
    assert parse_pipeline(f"add-sensor{text}").run(document, sink) is document
    [found_names] = sink.diagnostics
    assert (found_names.rule.name, found_names.is_error, found_names.location.line) == ("nothing-to-add-to", True, 1)
    assert (found_names.message, found_names.found, found_names.help) == (message, found, help_)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("add-sensor{type=imo link=a}", "did you mean imu"),
        ("add-sensor{type=imu}", "needs the option link"),
        ("add-sensor{type=imu joint=a}", "needs the option link, not joint"),
        ("add-sensor{type=force_torque link=a}", "needs the option joint"),
        ("add-sensor{type=camera link=a widht=3}", "did you mean width"),
        ("add-sensor{type=camera link=a width=0}", "option width"),
        ("add-sensor{type=imu link=a rate=0}", "option rate"),
        ("add-sensor{type=imu link=a rate=-1}", "option rate"),
        ("add-sensor{type=imu link=a xyz=[1,2]}", "option xyz"),
        ('add-sensor{type=imu link=a topic="a b"}', "no topic"),
        ("add-sensor{type=imu link=a collision=b}", "only contact sensors"),
        ("add-sensor{type=lidar link=a}", "does not simulate lidar"),
        ("add-sensor{type=air_speed link=a release=fortress}", "does not simulate air_speed"),
        ("add-sensor{type=imu link=a gyro-stddev=-1}", "option gyro-stddev"),
        ("add-sensor{type=imu link=a noise=loud}", "option noise"),
        ("add-sensor{type=imu link=a xyz=[inf,0,0]}", "option xyz"),
        ('add-sensor{type=imu link=a sensor-name=""}', "option sensor-name"),
    ],
)
def test_a_wrong_option_is_reported_at_its_place(text: str, complaint: str) -> None:
    with pytest.raises(PipelineError, match=complaint):
        parse_pipeline(text)


def test_settings_have_names_of_their_own() -> None:
    own = {option_name(name, field) for name, field in AddSensor.model_fields.items()}
    assert not [option for type_ in addable() for option in AddSensor.fields_for(type_) if option in own]


def test_a_pass_is_written_as_it_was() -> None:
    text = "add-sensor{type=imu link=base rate=50 gyro-stddev=0.1}"
    assert str(parse_pipeline(text)) == text
