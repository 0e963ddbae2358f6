"""A robot with meshes and textures on the disk, small enough to be written by hand."""

import base64
from pathlib import Path

from tests.snippets import INERTIAL, STL
from tests.write_files import write_files

PNG = base64.b64decode(
    b"iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)
OBJ = b"mtllib arm.mtl\nusemtl skin\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
MTL = b"newmtl skin\nmap_Kd ../textures/skin.png\n"
ARM = f"""<?xml version="1.0"?>
<robot name="arm">
  <material name="skin"><texture filename="package://arm_description/textures/skin.png"/></material>
  <link name="base">
    {INERTIAL}
    <visual><geometry><mesh filename="package://arm_description/meshes/visual/base.obj"/></geometry></visual>
    <collision><geometry><mesh filename="package://arm_description/meshes/collision/base.STL"/></geometry></collision>
  </link>
  <link name="tip">
    {INERTIAL}
    <visual><geometry><mesh filename="package://arm_description/meshes/tip%20one.stl" scale="1 1 -1"/></geometry>
      <material name="skin"/></visual>
    <collision><geometry><box size="1 1 1"/></geometry></collision>
  </link>
  <joint name="elbow" type="revolute">
    <parent link="base"/><child link="tip"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="5" velocity="2"/>
  </joint>
</robot>
"""
FILES = {
    "package.xml": b"<package><name>arm_description</name></package>",
    "urdf/arm.urdf": ARM.encode(),
    "meshes/visual/base.obj": OBJ,
    "meshes/visual/arm.mtl": MTL,
    "meshes/textures/skin.png": PNG,
    "meshes/collision/base.STL": STL,
    "meshes/tip one.stl": STL.replace(b"tip", b"one"),
    "textures/skin.png": PNG,
}


def arm(folder: Path) -> Path:
    """The file of the robot in a package of its own below the folder."""
    return write_files(folder / "arm_description", FILES) / "urdf/arm.urdf"
