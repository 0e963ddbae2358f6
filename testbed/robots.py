"""Robots of any size, always the same ones."""

import math

BRANCHING = 3
ELEMENTS_PER_LINK = 21


def urdf(links: int, *, branching: int = BRANCHING) -> str:
    """A tree of links in which every link has so many children, with about twenty elements for each link."""
    parts = [_link(0), *(_joint(number, branching) + _link(number) for number in range(1, links))]
    material = '  <material name="grey">\n    <color rgba="0.5 0.5 0.5 1"/>\n  </material>\n'
    name = "chain" if branching == 1 else "tree"
    return f'<?xml version="1.0"?>\n<robot name="{name}_of_{links}">\n{material}{"".join(parts)}</robot>\n'


def chain(links: int) -> str:
    """A chain of links: the same elements, and every link has one child."""
    return urdf(links, branching=1)


def _link(number: int) -> str:
    mass = 0.5 + _digits(number, 1)
    moments = " ".join(f'{name}="{_moment(name, mass)}"' for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
    return f"""  <link name="link_{number}">
    <inertial>
      <origin xyz="{_vector(number, 2)}" rpy="0 0 0"/>
      <mass value="{mass}"/>
      <inertia {moments}/>
    </inertial>
    <visual>
      <origin xyz="{_vector(number, 3)}" rpy="{_vector(number, 4)}"/>
      <geometry>
        <box size="0.1 0.2 {0.1 + _digits(number, 5)}"/>
      </geometry>
      <material name="grey"/>
    </visual>
    <collision>
      <origin xyz="{_vector(number, 3)}" rpy="{_vector(number, 4)}"/>
      <geometry>
        <cylinder radius="{0.05 + _digits(number, 6)}" length="0.3"/>
      </geometry>
    </collision>
  </link>
"""


def _joint(number: int, branching: int) -> str:
    return f"""  <joint name="joint_{number}" type="revolute">
    <parent link="link_{(number - 1) // branching}"/>
    <child link="link_{number}"/>
    <origin xyz="{_vector(number, 7)}" rpy="{_vector(number, 8)}"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1.57" upper="1.57" effort="{10_000 + _digits(number, 9)}" velocity="2"/>
    <dynamics damping="0.1" friction="{_digits(number, 10)}"/>
  </joint>
"""


def _moment(name: str, mass: float) -> float:
    return 0 if name[1] != name[2] else round(0.01 * mass, 6)


def _vector(number: int, salt: int) -> str:
    return " ".join(str(_digits(number, salt + 0.1 * axis)) for axis in range(3))


def _digits(number: int, salt: float) -> float:
    """A number from 0 to 1 with as many digits as real files have; no two are alike."""
    return round(abs(math.sin(number * 12.9898 + salt * 78.233)), 6)
