"""Scenes of documents: names, places, colors, sensors, and what cannot be placed."""

import math

import pytest

import twinform
from twinform.compiler.scene import Scene, build_scene
from twinform.ir import Document, Model

_WORLD = """<sdf version="1.11"><world name="w">
  <model name="m"><pose>0 0 1 0 0 0</pose>
    <link name="a"><visual name="v"><pose>0 1 0 0 0 0</pose><geometry><box><size>1 1 1</size></box></geometry>
      <material><diffuse>1 0 0 1</diffuse></material></visual></link>
    <model name="inner"><pose>1 0 0 0 0 0</pose><link name="b"/><frame name="f"><pose>0 0 2 0 0 0</pose></frame></model>
    <joint name="j" type="revolute"><parent>a</parent><child>inner::b</child><axis><xyz>0 0 1</xyz></axis></joint>
  </model>
  <model name="n"><link name="a"/></model>
  <joint name="between" type="fixed"><parent>m::a</parent><child>n::a</child></joint>
</world></sdf>"""


def _scene(text: str) -> Scene:
    return build_scene(twinform.loads(text))


def test_a_world_has_scoped_names_and_world_poses() -> None:
    scene = _scene(_WORLD)
    assert {link.name: link.pose.translation for link in scene.links} == {
        "m::a": (0, 0, 1),
        "m::inner::b": (1, 0, 1),
        "n::a": (0, 0, 0),
    }
    assert {(joint.name, joint.parent, joint.child) for joint in scene.joints} == {
        ("m::j", "m::a", "m::inner::b"),
        ("between", "m::a", "n::a"),
    }
    assert {frame.name: frame.link for frame in scene.frames}["m::inner::f"] == "m::inner::b"
    (shape,) = scene.links[0].shapes
    assert (shape.color, shape.pose.translation) == ((1, 0, 0, 1), (0, 1, 0))


def test_what_gazebo_elements_say_is_shown() -> None:
    scene = _scene(
        """<robot name="r"><material name="red"><color rgba="1 0 0 1"/></material>
        <link name="a"><visual><geometry><sphere radius="1"/></geometry><material name="red"/></visual></link>
        <gazebo reference="a"><sensor name="s" type="camera"><camera><horizontal_fov>1.2</horizontal_fov>
          <image><width>200</width><height>100</height></image><clip><near>0.1</near><far>5</far></clip>
        </camera></sensor></gazebo></robot>"""
    )
    assert scene.links[0].shapes[0].color == (1, 0, 0, 1)
    (sensor,) = scene.sensors
    (frustum,) = sensor.frustums
    assert (sensor.link, frustum.horizontal, frustum.near, frustum.far) == ("a", 1.2, 0.1, 5)
    assert math.tan(frustum.vertical / 2) == pytest.approx(math.tan(0.6) / 2)


def test_a_lidar_has_rays_within_its_range() -> None:
    scene = _scene(
        """<sdf version="1.11"><model name="m"><link name="a"><sensor name="s" type="gpu_lidar"><lidar>
        <scan><horizontal><samples>640</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>
        <range><min>0.5</min><max>3</max></range></lidar></sensor></link></model></sdf>"""
    )
    rays = scene.sensors[0].rays
    assert 2 < len(rays) <= 24
    assert {round(math.dist((0, 0, 0), ray.end), 9) for ray in rays} == {3}
    assert {round(math.atan2(ray.end[1], ray.end[0]), 9) for ray in (rays[0], rays[-1])} == {-1, 1}


def test_what_cannot_be_placed_is_said() -> None:
    document = twinform.loads(_WORLD)
    (world,) = document.worlds
    model: Model = world.models[0]
    link = model.links[0].copy(pose=None, name="lost")
    broken = model.copy(links=(link,))
    scene = build_scene(document.copy(worlds=(world.copy(models=(broken,)),)))
    assert any(reason.startswith("j: ") for reason in scene.left_out)
    assert [each.name for each in scene.links] == ["m::lost", "m::inner::b"]


def test_nothing_is_a_scene_of_nothing() -> None:
    assert build_scene(Document(format=twinform.loads(_WORLD).format)) == Scene()
