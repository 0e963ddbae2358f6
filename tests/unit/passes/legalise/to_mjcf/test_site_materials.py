"""The material of a site goes with its model out of a world; a site keeps no name of one that has been deleted."""

import twinform

_WORLD = b"""<mujoco model="scene">
  <asset><material name="mark" rgba="1 0 0 1"/></asset>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 1"/>
    <body name="arm">
      <joint name="shoulder" axis="0 1 0"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <site name="tip" material="mark"/>
    </body>
  </worldbody>
</mujoco>"""


def test_a_material_goes_with_its_model() -> None:
    robot = twinform.convert(_WORLD, to="urdf", model="scene").text
    written = twinform.convert(robot.encode(), to="mjcf").text
    assert '<material name="mark" rgba="1 0 0 1"/>' in written
    assert '<site name="tip" material="mark"' in written


def test_a_material_that_was_deleted_is_not_named() -> None:
    """What is written can be read again."""
    robot = twinform.convert(_WORLD, to="urdf", model="scene").text
    edited = robot.replace('<material name="mark" rgba="1 0 0 1"/>', "")
    assert edited != robot
    written = twinform.convert(edited.encode(), to="mjcf").text
    assert '<site name="tip"' in written
    assert "mark" not in written
    assert twinform.loads(written.encode()).models
