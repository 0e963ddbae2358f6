"""Joints that close loops, as constraints of MJCF and back."""

from pathlib import Path

from lxml import etree

import twinform
from twinform.testing.properties import RoundTrip, assert_valid

_LOOP = """
<sdf version="1.11">
  <model name="m">
    <link name="a"/>
    <link name="b"><pose>0 0 1 0 0 0</pose></link>
    <joint name="first" type="revolute"><parent>a</parent><child>b</child><axis><xyz>1 0 0</xyz></axis></joint>
    <joint name="second" type="revolute">
      <parent>a</parent>
      <child>b</child>
      <axis>
        <xyz>0 1 0</xyz>
        <limit><lower>-1</lower><upper>1</upper></limit>
        <dynamics><damping>2</damping></dynamics>
      </axis>
    </joint>
  </model>
</sdf>
"""


def test_the_axis_of_a_joint_that_closes_a_loop_comes_back_with_its_limits(tmp_path: Path) -> None:
    source, made, back = tmp_path / "source.sdf", tmp_path / "made.xml", tmp_path / "back.sdf"
    source.write_text(_LOOP)
    made.write_text(twinform.convert(source, to="mjcf").text)
    back.write_text(twinform.convert(made, to="sdf", sdf_version="1.11").text)
    (model,) = twinform.load(back).models
    (before,) = twinform.load(source).models
    assert model.joint("second").replace(opaque=()) == before.joint("second")


_SWING = """
<sdf version="1.9">
  <model name="m">
    <link name="door"/>
    <model name="frame"><static>true</static><pose>0.5 0 0 0 0 0</pose><link name="post"/></model>
    <joint name="hinge" type="revolute">
      <parent>door</parent><child>frame::post</child><axis><xyz>0 0 1</xyz></axis>
    </joint>
  </model>
</sdf>
"""


def test_a_static_link_that_hangs_from_a_moving_one_stays_in_the_world_and_comes_back() -> None:
    model = _SWING.encode()
    made = twinform.convert(model, to="mjcf").text
    tree = etree.fromstring(made.encode())
    assert [each.get("name") for each in tree.iterfind("worldbody/body")] == ["door", "frame::post"]
    held = [(each.get("body1"), each.get("body2"), each.get("anchor")) for each in tree.iterfind("equality/connect")]
    assert held == [("door", "frame::post", "0.5 0 0"), ("door", "frame::post", "0.5 0 0.1")]
    trip = RoundTrip.of(model, assert_valid(model))
    assert [each.message for each in trip.mismatches(trip.back(made))] == []
