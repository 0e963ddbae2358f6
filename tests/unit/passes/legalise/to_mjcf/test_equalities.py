"""Joints that close loops, as constraints of MJCF and back."""

from pathlib import Path

import twinform

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
