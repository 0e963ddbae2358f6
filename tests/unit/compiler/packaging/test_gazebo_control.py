"""Rules: foreign-hardware, replaced-controllers-file."""

import pytest

from twinform.compiler.packaging.gazebo_control import ConnectControllers
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Plugin
from twinform.passes.plugins.release_names import ReleaseName
from twinform.passes.plugins.sites import plugins_of

from .ros2_robots import GAZEBO, interfaces, joint, link, robot, system

OLD = "ign_ros2_control/IgnitionSystem"
OWN = "package://pkg/config/controllers.yaml"


def arm(hardware: str = GAZEBO, plugin: str = "") -> Document:
    return robot(link("a"), joint("j", "a"), system(interfaces("j", "position"), hardware=hardware), plugin)


def connected(document: Document, release: ReleaseName = "harmonic") -> tuple[Document, list[str]]:
    sink = DiagnosticSink()
    done = ConnectControllers(package="pkg", release=release).run(document, sink)
    return done, [f"{each.rule.name}: {each.message}" for each in sink.diagnostics]


def the_plugin(document: Document) -> Plugin:
    ((plugin, _),) = plugins_of(document)
    return plugin


@pytest.mark.parametrize(
    ("release", "hardware", "filename", "name"),
    [
        ("harmonic", GAZEBO, "gz_ros2_control-system", "gz_ros2_control::GazeboSimROS2ControlPlugin"),
        ("jetty", OLD, "gz_ros2_control-system", "gz_ros2_control::GazeboSimROS2ControlPlugin"),
        ("fortress", OLD, "ign_ros2_control-system", "ign_ros2_control::IgnitionROS2ControlPlugin"),
    ],
)
def test_the_plugin_is_that_of_the_release(release: ReleaseName, hardware: str, filename: str, name: str) -> None:
    document, messages = connected(arm(hardware), release)
    plugin = the_plugin(document)
    assert (plugin.filename, plugin.name) == (filename, name)
    assert [(each.name, each.text) for each in plugin.content] == [("parameters", OWN)]
    assert messages == []


def test_a_plugin_that_is_there_reads_the_files_of_the_package() -> None:
    plugin = (
        '<gazebo><plugin filename="libgz_ros2_control-system.so" name="gz_ros2_control::GazeboSimROS2ControlPlugin">'
        "<parameters>/home/me/a.yaml</parameters><hold_joints>false</hold_joints><parameters>b.yaml</parameters>"
        "</plugin></gazebo>"
    )
    document, messages = connected(arm(plugin=plugin))
    assert [(each.name, each.text) for each in the_plugin(document).content] == [
        ("parameters", OWN),
        ("hold_joints", "false"),
    ]
    assert messages == [
        f"replaced-controllers-file: the controllers' file {each!r} gives way to config/controllers.yaml of the package"
        for each in ("/home/me/a.yaml", "b.yaml")
    ]
    again, messages = connected(document)
    assert again == document
    assert messages == []


@pytest.mark.parametrize(
    ("release", "hardware"), [("harmonic", "mock_components/GenericSystem"), ("fortress", GAZEBO), ("jetty", "")]
)
def test_other_hardware_is_left_alone_and_reported(release: ReleaseName, hardware: str) -> None:
    document = arm(hardware)
    same, messages = connected(document, release)
    assert same is document
    assert messages == [f"foreign-hardware: ros2_control 'main' has {hardware!r}, which Gazebo {release} does not load"]


def test_a_model_without_a_system_is_left_alone() -> None:
    document = robot(link("a"), joint("j", "a"))
    assert connected(document) == (document, [])
