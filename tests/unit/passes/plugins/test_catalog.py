from typing import get_args

import pytest

from twinform.passes.plugins import catalog
from twinform.passes.plugins.catalog import (
    UnknownNameError,
    custom_sensor,
    nearest,
    releases,
    sensor,
    sensors,
    system,
    systems,
)
from twinform.passes.plugins.catalog_types import PluginKind, PluginParameter
from twinform.passes.plugins.release_names import ReleaseName

ALL = [
    *systems().values(),
    *catalog.classic_plugins("noetic").values(),
    *catalog.classic_plugins("ros2").values(),
]


def test_the_official_tutorials_parameter_is_not_one_and_the_right_one_is_near() -> None:
    names = [row.name for row in system("diff-drive").parameters]
    assert system("diff-drive").parameter("odom_publisher_frequency") is None
    assert nearest("odom_publisher_frequency", names) == "odom_publish_frequency"


@pytest.mark.parametrize(
    "spelling", ["gz-sim-imu-system", "libgz-sim-imu-system.so", "libignition-gazebo6-imu-system.so"]
)
def test_a_system_is_found_by_every_spelling_of_its_file(spelling: str) -> None:
    assert [each.name for each in catalog.systems_of_file(spelling)] == ["imu"]


def test_one_file_may_hold_several_systems() -> None:
    assert {each.name for each in catalog.systems_of_file("gz-sim-thermal-sensor-system")} == {"thermal-sensor"}
    assert {each.name for each in catalog.systems_of_file("gz-sim-log-system")} == {"log-record", "log-playback"}


def test_a_class_of_ignition_is_the_one_of_gz() -> None:
    found = catalog.system_of_class("ignition::gazebo::systems::DiffDrive")
    assert found is system("diff-drive")


def test_a_plugin_of_gazebo_classic_is_distinguished_by_its_ros() -> None:
    found = catalog.classic_plugins_of_file("/opt/ros/lib/libgazebo_ros_diff_drive.so")
    assert found["noetic"].parameter("wheelSeparation")
    assert found["ros2"].parameter("wheel_separation")


def test_parameters_of_a_family_of_names_are_known() -> None:
    assert system("hydrodynamics").parameter("xUabsU")
    assert system("hydrodynamics").parameter("xUxU") is None


def test_a_parameter_knows_its_releases() -> None:
    found = system("joint-state-publisher").parameter("update_rate")
    assert found is not None
    assert found.releases & releases().keys() == {"fortress", "harmonic", "ionic", "jetty"}


def test_what_is_unknown_is_an_error_that_reports_what_is_near() -> None:
    with pytest.raises(UnknownNameError, match="did you mean diff-drive"):
        system("dif_drive")
    with pytest.raises(UnknownNameError, match="did you mean harmonic"):
        catalog.release("harmonik")
    with pytest.raises(UnknownNameError, match="there is no sensor"):
        sensor("nose")


@pytest.mark.parametrize("kind", ALL, ids=lambda kind: f"{kind.name}-{kind.file}")
def test_every_row_of_the_tables_makes_sense(kind: PluginKind) -> None:
    rows = dict(kind.walk())
    assert kind.releases
    assert len(rows) == len(list(kind.walk()))
    for path, row in rows.items():
        _make_sense(path, row)
    names = {row.name for row in kind.parameters}
    for channel in kind.channels:
        mentioned = {channel.parameter, *sum((*channel.unless, *channel.when), ()), *(channel.each[:1])} - {None}
        mentioned |= {name for each in channel.alternatives for name in each.parameters}
        assert mentioned <= names
        assert channel.message.startswith("gz.msgs.")


def _make_sense(path: tuple[str, ...], row: PluginParameter) -> None:
    assert row.count in "1?*+", path
    assert row.type in {
        "number", "integer", "bool", "text", "joint", "link", "collision", "topic", "vector", "numbers", "pose",
        "color", "element",
    }, path  # fmt: skip
    assert row.releases, path
    assert row.default is None or not row.choices or row.default in row.choices, path
    assert row.type != "element" or row.free or row.children, path


def test_sensors_name_systems_that_there_are() -> None:
    for kind in sensors().values():
        assert all(name in systems() for name in kind.systems)
        assert kind.releases
    assert sensor("gps") is sensor("navsat")


def test_custom_sensors_go_by_their_own_word() -> None:
    assert custom_sensor("dvl") is sensors()["dvl"]
    assert custom_sensor("environmental_sensor/humidity") is sensors()["environmental_sensor"]
    assert not any(map(custom_sensor, ("", "odometer", "dvl/x", "environmental_sensor")))
    with pytest.raises(UnknownNameError):
        sensor("dvl")


def test_an_element_that_is_asked_for_as_an_attribute_of_the_plugin_is_no_parameter() -> None:
    assert system("joint-trajectory-controller").parameter("use_header_start_time") is None
    assert system("led-plugin").parameter("mode", "step", "@always_on") is not None


@pytest.mark.parametrize(
    ("name", "path", "default", "unit"),
    [
        ("lift-drag", ("alpha_stall",), "1.57079632679", "rad"),
        ("thruster", ("p_gain",), "0.1", None),
        ("multicopter-motor-model", ("timeConstantUp",), "0.0125", "s"),
        ("diff-drive", ("max_velocity",), None, "m/s|rad/s"),
        ("tracked-vehicle", ("angular_velocity", "max_jerk"), None, "rad/s^3"),
        ("linear-battery", ("capacity",), None, "A*h"),
    ],
)
def test_defaults_and_units_are_those_of_the_sources(
    name: str, path: tuple[str, ...], default: str | None, unit: str | None
) -> None:
    row = system(name).parameter(*path)
    assert row is not None
    assert (row.default, row.unit) == (default, unit)


def test_every_release_has_physics_and_a_version_of_sdf() -> None:
    assert tuple(releases()) == get_args(ReleaseName)
    assert [each.sdf for each in releases().values()] == ["1.9", "1.10", "1.11", "1.12", "1.12"]
    assert all(name in system("physics").releases for name in releases())
