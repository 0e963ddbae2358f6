"""One sensor of several cameras becomes several sensors."""

import pytest

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Element, Plugin, Sensor
from twinform.passes.classic.migrate_sensors import SensorMigration
from twinform.passes.plugins.catalog import release
from twinform.passes.plugins.sites import PluginSite, sensor_of

MINE = Plugin(name="mine", filename="libmine.so")
DRIVER = Plugin(
    name="driver",
    filename="libgazebo_ros_multicamera.so",
    content=(Element(name="updateRate", text="3"), Element(name="nonsense", text="1")),
)
SITE = PluginSite("link", "head")


def eyes(*names: str | None, plugins: tuple[Plugin, ...] = (MINE, DRIVER)) -> Sensor:
    cameras = tuple(Element(name="camera", attributes=(("name", name),) if name else ()) for name in names)
    made = sensor_of(Element(name="sensor", attributes=(("name", "eyes"), ("type", "multicamera")), children=cameras))
    assert made is not None
    return made.copy(plugins=plugins)


def split(sensor: Sensor) -> tuple[list[Sensor], DiagnosticSink]:
    sink = DiagnosticSink()
    return list(SensorMigration(release("harmonic"), sink)(sensor, SITE)), sink


@pytest.mark.parametrize("count", [1, 2, 3])
def test_other_plugins_go_with_the_first_camera_alone(count: int) -> None:
    made, _ = split(eyes(*"lcr"[:count]))
    assert [(each.name, each.type) for each in made] == [(f"eyes_{name}", "camera") for name in "lcr"[:count]]
    assert [each.plugins for each in made] == [(MINE,), (), ()][:count]


def test_each_camera_has_the_parameters_and_topics_of_its_own_name() -> None:
    made, _ = split(eyes("l", None, plugins=(DRIVER,)))
    assert [(each.name, each.update_rate, each.topic) for each in made] == [
        ("eyes_l", 3.0, "driver/l/image_raw"),
        ("eyes_1", 3.0, "driver/1/image_raw"),
    ]
    assert [each.plugins for each in made] == [(), ()]


def test_what_is_lost_is_lost_once_and_the_sensor_is_reported_as_several() -> None:
    _, sink = split(eyes("l", "r"))
    message = "sensor 'eyes' on 'head' had the type multicamera and is now 2 cameras"
    assert [(each.rule.name, each.found) for each in sink.diagnostics] == [
        ("migrated-plugin", "libgazebo_ros_multicamera.so"),
        ("parameter-without-counterpart", "1"),
        ("migrated-sensor", "multicamera"),
    ]
    assert sink.diagnostics[-1].message == message
    split_ = [each for each in sink.entries if each.rule.name == "migrated-sensor"]
    assert {each.message for each in split_} == {message}
    assert [each.location.path.rpartition("@")[2] for each in split_] == ["type", "name", "name", "name"]


def test_without_a_plugin_of_gazebo_classic_it_is_split_as_well() -> None:
    made, sink = split(eyes("l", "r", plugins=(MINE,)))
    assert [(each.name, each.topic, each.plugins) for each in made] == [
        ("eyes_l", None, (MINE,)),
        ("eyes_r", None, ()),
    ]
    assert [each.rule.name for each in sink.diagnostics] == ["migrated-sensor"]
