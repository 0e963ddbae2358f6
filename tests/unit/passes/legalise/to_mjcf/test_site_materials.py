"""A site keeps no name of a material that stayed behind in the world that its model was taken out of."""

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


def test_a_material_that_stayed_behind_is_not_named() -> None:
    """What is written can be read again."""
    robot = twinform.convert(_WORLD, to="urdf", model="scene").text
    written = twinform.convert(robot.encode(), to="mjcf").text
    assert '<site name="tip"' in written
    assert "mark" not in written
    assert twinform.loads(written.encode()).models
