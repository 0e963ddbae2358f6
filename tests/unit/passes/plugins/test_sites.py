from collections.abc import Iterable

import pytest

import twinform
from twinform.ir import Document, Plugin, Sensor, replace_node
from twinform.passes.plugins.add_elements import add_plugin, add_sensor, add_world_plugin
from twinform.passes.plugins.sites import PluginSite, map_plugins, map_sensors, plugins_of, sensors_of

URDF = """<robot name="r">
  <ros2_control name="c" type="system"><hardware><plugin>fake/System</plugin></hardware></ros2_control>
  <link name="base"/><link name="arm"/>
  <joint name="hip" type="fixed"><parent link="base"/><child link="arm"/></joint>
  <gazebo>
    <plugin name="drive" filename="libdrive.so" extra="1"><left_joint>hip</left_joint></plugin>
  </gazebo>
  <gazebo reference="arm">
    <mu1>0.5</mu1>
    <sensor name="eye" type="camera">
      <update_rate>30</update_rate>
      <plugin name="c" filename="libcamera.so"/>
    </sensor>
  </gazebo>
  <gazebo reference="hip"><sensor name="force" type="force_torque"/></gazebo>
  <gazebo reference="base"><visual><plugin name="v" filename="libv.so"/></visual></gazebo>
</robot>"""
SDF = """<sdf version="1.11"><world name="w">
  <plugin name="p" filename="physics"/>
  <gui><plugin name="g" filename="gui"/></gui>
  <model name="r">
    <link name="base"><visual name="v"><plugin name="v" filename="v"/></visual></link>
    <link name="arm"><sensor name="eye" type="camera"><plugin name="c" filename="c"/></sensor></link>
    <joint name="hip" type="fixed">
      <parent>base</parent><child>arm</child><sensor name="force" type="force_torque"/>
    </joint>
    <plugin name="drive" filename="drive"/>
    <model name="inner"><link name="l"/><plugin name="deep" filename="deep"/></model>
  </model>
  <actor name="walker"><plugin name="a" filename="actor"/></actor>
</world></sdf>"""
MODEL = f"<sdf version='1.11'>{SDF[SDF.index('<model') : SDF.index('<actor')]}</sdf>"


def load(text: str) -> Document:
    return twinform.loads(text)


def where(document: Document) -> list[tuple[str | None, str, str]]:
    return [(plugin.name, site.scope, site.holder) for plugin, site in plugins_of(document)]


def test_the_plugins_of_a_urdf_file_stand_where_gazebo_puts_them() -> None:
    assert where(load(URDF)) == [("drive", "model", "r"), ("c", "sensor", "eye"), ("v", "visual", "")]


def test_the_plugins_of_an_sdf_file_are_all_found() -> None:
    found = where(load(SDF))
    assert sorted(found) == sorted(
        [
            ("p", "world", "w"),
            ("g", "gui", ""),
            ("v", "visual", "v"),
            ("c", "sensor", "eye"),
            ("drive", "model", "r"),
            ("deep", "model", "inner"),
            ("a", "actor", "walker"),
        ]
    )


@pytest.mark.parametrize("text", [URDF, SDF])
def test_sensors_stand_on_links_and_joints(text: str) -> None:
    found = [(each.name, each.type, site.scope, site.holder) for each, site in sensors_of(load(text))]
    assert found == [("eye", "camera", "link", "arm"), ("force", "force_torque", "joint", "hip")]


@pytest.mark.parametrize("text", [URDF, SDF])
def test_a_walk_that_changes_nothing_gives_the_same_document(text: str) -> None:
    document = load(text)
    assert map_plugins(document, lambda plugin, _: (plugin,)) is document
    assert map_sensors(document, lambda sensor, _: (sensor,)) is document


@pytest.mark.parametrize("text", [URDF, SDF])
def test_plugins_are_replaced_removed_and_multiplied(text: str) -> None:
    def change(plugin: Plugin, _: PluginSite) -> Iterable[Plugin]:
        if plugin.name == "v":
            return ()
        if plugin.name == "c":
            return (plugin, plugin.copy(name="c2"))
        return (plugin,)

    made = [name for name, _, _ in where(map_plugins(load(text), change))]
    assert "v" not in made
    assert made.index("c2") == made.index("c") + 1


@pytest.mark.parametrize("text", [URDF, SDF])
def test_sensors_are_changed(text: str) -> None:
    def change(sensor: Sensor, _: PluginSite) -> Iterable[Sensor]:
        return (sensor.copy(topic="here", plugins=()),) if sensor.name == "eye" else ()

    made = map_sensors(load(text), change)
    assert [(each.name, each.topic) for each, _ in sensors_of(made)] == [("eye", "here")]
    assert "c" not in [name for name, _, _ in where(made)]


def test_what_a_plugin_has_is_kept() -> None:
    document = load(URDF)
    renamed = map_plugins(document, lambda plugin, _: (plugin.copy(name="other"),))
    back = map_plugins(renamed, lambda plugin, site: (plugin.copy(name=_names(document, site)),))
    assert back == document


def _names(document: Document, site: PluginSite) -> str | None:
    return next(plugin.name for plugin, place in plugins_of(document) if place.scope == site.scope)


@pytest.mark.parametrize("text", [URDF, MODEL])
def test_plugins_and_sensors_are_added_to_either_language(text: str) -> None:
    document = (
        load("".join(text.split("<actor")[:1]) + "</sdf>" if "<actor" in text else text)
        if "sdf" in text
        else load(text)
    )
    model = document.models[0]
    made = add_plugin(model, Plugin(name="n", filename="f"), document.format)
    made = add_sensor(made, "hip", Sensor(name="s", type="force_torque"), document.format)
    changed = replace_node(document, model, made)
    assert ("n", "model", "r") in where(changed)
    assert ("s", "hip") in [(each.name, site.holder) for each, site in sensors_of(changed)]


def test_plugins_are_added_to_worlds() -> None:
    document = load(SDF)
    world = add_world_plugin(document.worlds[0], Plugin(name="n", filename="f"))
    assert [plugin.name for plugin in world.plugins] == ["p", "n"]


def test_deeply_nested_models_are_walked() -> None:
    depth = 60
    names = "".join(f'<model name="m{number}">' for number in range(depth))
    inside = '<link name="l"><sensor name="s" type="imu"/></link><plugin name="p" filename="f"/>'
    document = load(f'<sdf version="1.11">{names}{inside}{"</model>" * depth}</sdf>')
    [(_, site)] = plugins_of(document)
    assert len(site.models) == depth
    assert len(sensors_of(document)) == 1
