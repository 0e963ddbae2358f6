"""The bridge names the topics that Gazebo has: held against a table made from the sources of gz-sim and gz-sensors."""

from collections.abc import Mapping
from xml.sax.saxutils import escape, quoteattr

import pytest
from hypothesis import given
from hypothesis import strategies as st

import twinform
from tests.profile import examples
from tests.snippets import INERTIAL
from tests.unit.passes.plugins.advertised import SENSORS, SYSTEMS, WITHOUT, WITHOUT_SENSORS, Row, Sdf, SensorSdf
from twinform.passes.plugins.catalog import releases, sensors, system, systems
from twinform.passes.plugins.topics import topics_of

RELEASES = list(releases())
ODD = (
    "my robot",
    "a@b",
    "x~y",
    "p:=q",
    "a/b",
    "b//c",
    "//",
    "~",
    "/r",
    "r/",
    "~/out",
    "é 名",
    "a&b<c",
    "#1",
    "50%",
    "@",
)
IN_CAMERA = {"camera_info_topic", "box_type", "triggered", "trigger_topic"}
CUSTOM = {"dvl": "dvl", "environmental_sensor": "environmental_sensor/humidity"}
BOX_TYPES = ("2d", "visible_2d", "visible_box_2d", "full_2d", "full_box_2d", "3d", "4d", "")
drawn_names = st.text("ab/ @~:=", min_size=1, max_size=5).filter(lambda text: text == text.strip() and "::" not in text)
names = st.sampled_from(("r", "arm_2", *ODD)) | drawn_names
values = {
    "topic": names | st.just(""),
    "name": names | st.just(""),
    "name!": names,
    "names": st.lists(names, max_size=2),
    "bool": st.sampled_from(("true", "1", "false", "0")),
    "int": st.integers(0, 3).map(str),
    "breadcrumb": st.sampled_from(("b", "b c", "a/b", "x~y")),
}


def written(parameters: Mapping[str, list[str]]) -> str:
    """The parameters of a plugin in XML."""
    crumb = "<{0}><sdf version='1.6'><model name={1}><link name='l'/></model></sdf></{0}>"
    return "".join(
        crumb.format(name, quoteattr(text)) if name == "breadcrumb" else f"<{name}>{escape(text)}</{name}>"
        for name, texts in parameters.items()
        for text in texts
    )


def named(rows: set[Row]) -> set[Row]:
    """Topics as the bridge names them: with a slash before them and none behind."""
    return {(way, message, f"/{topic.removeprefix('/').removesuffix('/')}") for way, message, topic in rows if topic}


def found(document: twinform.Document, release: str, world: str) -> set[Row]:
    """The topics that we say there are."""
    topics = topics_of(document, release, world)
    return {(each.direction, each.message.removeprefix("gz.msgs."), each.name) for each in topics if not each.missing}


def sdf(world: str, models: tuple[str, ...], content: str) -> twinform.Document:
    for name in reversed(models):
        content = f"<model name={quoteattr(name)}><link name='base'/>{content}</model>"
    return twinform.loads(f"<sdf version='1.11'><world name={quoteattr(world)}>{content}</world></sdf>")


def urdf(model: str, content: str, links: str = f"<link name='base'>{INERTIAL}</link>") -> twinform.Document:
    return twinform.loads(f"<robot name={quoteattr(model)}>{links}{content}</robot>")


@examples()
@given(data=st.data())
@pytest.mark.parametrize("name", SYSTEMS)
def test_the_topics_of_a_system_are_those_of_its_source(name: str, data: st.DataObject) -> None:
    entry, kind = SYSTEMS[name], system(name)
    release = data.draw(st.sampled_from([each for each in RELEASES if each in kind.releases]))
    parameters: dict[str, list[str]] = {}
    for parameter, type_ in entry.takes.items():
        if type_.endswith("!") or data.draw(st.booleans()):
            drawn = data.draw(values[type_] if type_ in values else values[type_.removesuffix("!")])
            parameters[parameter] = drawn if isinstance(drawn, list) else [drawn]
    spawned = data.draw(st.booleans())
    models = tuple(data.draw(st.lists(names, min_size=1, max_size=1 if spawned else 2)))
    world = data.draw(names)
    more = "<microphone><id>7</id></microphone>" if name == "logical-audio-sensor" else ""
    plugin = f"<plugin filename='{kind.file}' name='{kind.class_name}'>{written(parameters)}{more}</plugin>"
    in_world = kind.scopes == ("world",)
    if in_world:
        document, spawned = sdf(world, (), plugin), False
    else:
        document = urdf(models[0], f"<gazebo>{plugin}</gazebo>") if spawned else sdf(world, models, plugin)
    source = Sdf(release, world, models, spawned, {key: texts for key, texts in parameters.items() if texts})
    assert found(document, release, world) == named(set(entry.rows(source)))


@examples()
@given(data=st.data())
@pytest.mark.parametrize("type_", SENSORS)
def test_the_topics_of_a_sensor_are_those_of_its_source(type_: str, data: st.DataObject) -> None:
    entry = SENSORS[type_]
    release = data.draw(st.sampled_from(RELEASES[RELEASES.index(entry.since) :]))
    spawned, world, own = data.draw(st.booleans()), data.draw(names), data.draw(names)
    models = tuple(data.draw(st.lists(names, min_size=1, max_size=1 if spawned else 2)))
    parameters: dict[str, list[str]] = {}
    for parameter, default in (
        ("topic", "__default__"),
        ("contact_topic", "__default_topic__"),
        ("camera_info_topic", "__default__"),
    ):
        # libsdformat refuses a file in which the topic in <contact> is empty (Param.cc, a required one)
        empty = st.nothing() if parameter == "contact_topic" else st.just("")
        if data.draw(st.booleans()):
            parameters[parameter] = [data.draw(names | empty | st.sampled_from(("__default_topic__", default)))]
    if "camera" in type_ and type_ != "logical_camera" and data.draw(st.booleans()):
        parameters["triggered"] = [data.draw(st.sampled_from(("true", "1", "false", "0")))]
        parameters["trigger_topic"] = [data.draw(names | st.just(""))]
    if type_ == "boundingbox_camera" and data.draw(st.booleans()):
        parameters["box_type"] = [data.draw(st.sampled_from(BOX_TYPES))]
    topic = written({key: parameters[key] for key in parameters if key == "topic"})
    inner = written({"topic": parameters["contact_topic"]} if "contact_topic" in parameters else {})
    info = written({key: parameters[key] for key in parameters if key in IN_CAMERA})
    custom = f"custom' gz:type='{CUSTOM[type_]}" if type_ in CUSTOM else type_
    if type_ == "environmental_sensor" and data.draw(st.booleans()):
        parameters["output_format"] = [data.draw(st.sampled_from(("scalar", "vector3", "other")))]
    topic += written({key: parameters[key] for key in parameters if key == "output_format"})
    content = f"<contact><collision>c</collision>{inner}</contact>" if type_ == "contact" else ""
    content += f"<camera>{info}</camera>" if "camera" in type_ and type_ != "logical_camera" else ""
    sensor = f"<sensor name={quoteattr(own)} type='{custom}'>{topic}{content}</sensor>"
    on_joint = type_ == "force_torque"
    holder, kept = ("joint", "j") if on_joint else ("link", data.draw(names)), data.draw(st.booleans())
    if spawned:
        document = robot(models[0], holder, sensor, kept=kept)
        if not kept and on_joint:
            assert found(document, release, world) == set()
            return
        holder = holder if kept or on_joint else ("link", "root link")
    else:
        held = f"<{holder[0]} name={quoteattr(holder[1])}"
        held += (
            f" type='fixed'><parent>world</parent><child>base</child>{sensor}</joint>"
            if on_joint
            else f">{sensor}</link>"
        )
        document = sdf(world, models, held)
    source = SensorSdf(release, world, models, spawned, parameters, holder, own)
    rows = list(entry.rows(source))
    expected = set(rows) if all(topic for way, _, topic in rows if way == "<") else set[Row]()
    assert found(document, release, world) == named(expected)


def robot(model: str, holder: tuple[str, str], sensor: str, *, kept: bool) -> twinform.Document:
    """A robot whose sensor is on a link that a fixed joint holds, or on that joint, which Gazebo keeps or not."""
    link = "tip" if holder[0] == "joint" else holder[1]
    links = f"<link name='root link'>{INERTIAL}</link><link name={quoteattr(link)}>{INERTIAL}</link>"
    joint = f"<joint name='j' type='fixed'><parent link='root link'/><child link={quoteattr(link)}/></joint>"
    keeping = "<gazebo reference='j'><preserveFixedJoint>true</preserveFixedJoint></gazebo>" if kept else ""
    return urdf(model, f"{joint}{keeping}<gazebo reference={quoteattr(holder[1])}>{sensor}</gazebo>", links)


def test_the_table_is_about_all_that_the_catalog_has() -> None:
    assert {*SYSTEMS, *WITHOUT} == set(systems())
    assert {*SENSORS, *WITHOUT_SENSORS} == set(sensors())
    assert not {*SYSTEMS} & {*WITHOUT} | {*SENSORS} & {*WITHOUT_SENSORS}


@pytest.mark.parametrize("name", WITHOUT)
def test_a_system_without_a_topic_for_the_bridge_has_none(name: str) -> None:
    kind = system(name)
    channels = [channel for channel in kind.channels if channel.releases & {*RELEASES}]
    assert not channels
