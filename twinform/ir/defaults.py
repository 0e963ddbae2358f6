"""Default values of both formats. A test holds all of it to the facts tables."""

import math
from collections.abc import Mapping
from typing import TypeVar

from twinform.ir.document import Format
from twinform.ir.geometry import Box, Capsule, Cone, Cylinder, Ellipsoid, ShapeNode, Sphere
from twinform.ir.joint import Axis, Limit, Mimic
from twinform.ir.link import Inertia, Inertial
from twinform.ir.node import Node, Vector3

AnyNode = TypeVar("AnyNode", bound=Node)

AXIS: Mapping[Format, Vector3] = {Format.URDF: (1.0, 0.0, 0.0), Format.SDF: (0.0, 0.0, 1.0)}
"""The direction of a joint's axis, in the frame of the joint."""
RANGE: Mapping[Format, Limit] = {
    Format.URDF: Limit.unchecked(lower=0.0, upper=0.0),
    Format.SDF: Limit.unchecked(lower=-math.inf, upper=math.inf),
}
"""The ends of a `<limit>` that is written without them, in rad or m."""
# The default of <lower> and <upper> in the SDF specification up to 1.9 (`joint.sdf`).
UNLIMITED = 1e16
"""What stands for infinity in URDF, and in SDF before 1.10: rad, m, N m, N, rad/s or m/s."""
UNLIMITED_STRENGTH = -1.0
"""What stands for infinity in an effort or velocity of SDF from 1.3 to 1.9."""
MULTIPLIER = 1.0
"""How far a joint turns for each radian of the one that it mimics."""
GEARBOX_RATIO = 1.0
GRAVITY = 9.8
"""How strongly gravity pulls against z in a world that says nothing of it, m/s^2 (sdf/world.sdf)."""
SCREW_THREAD_PITCH = 1.0
"""In m per turn."""

MASS: Mapping[Format, float | None] = {Format.URDF: None, Format.SDF: 1.0}
"""In kg; URDF has no default, and a link without `<inertial>` weighs nothing there."""
MOMENT: Mapping[Format, float | None] = {Format.URDF: None, Format.SDF: 1.0}
"""Of inertia about each axis, in kg m^2; products are zero."""
INERTIAL = Inertial.unchecked(mass=1.0, inertia=Inertia.unchecked(ixx=1.0, ixy=0.0, ixz=0.0, iyy=1.0, iyz=0.0, izz=1.0))
"""The mass of a link of SDF that has none written."""
DENSITY = 1000.0
"""In kg/m^3, of a collision of SDF: that of water."""
BODY: Mapping[str, bool] = {"gravity": True, "enable_wind": False, "kinematic": False}
"""The fields of a link of SDF about its body."""
FORCE_TORQUE: Mapping[str, str] = {"frame": "child", "measure_direction": "child_to_parent"}
"""The fields of a `<force_torque>` sensor in a joint."""

SIZES: Mapping[type[Node], Mapping[str, float | Vector3]] = {
    Box: {"size": (1.0, 1.0, 1.0)},
    Sphere: {"radius": 1.0},
    Ellipsoid: {"radii": (1.0, 1.0, 1.0)},
    Cylinder: {"radius": 1.0, "length": 1.0},
    Cone: {"radius": 1.0, "length": 1.0},
    Capsule: {"radius": 0.5, "length": 1.0},
}
"""The lengths of the shapes that are filled, in m."""


def filled(node: AnyNode, values: Mapping[str, object]) -> AnyNode:
    """Return the node with values in the fields that were not written; the node itself if there are none."""
    missing = {name: value for name, value in values.items() if getattr(node, name) is None}
    return node.copy(**missing) if missing else node


def with_range(limit: Limit, format_: Format) -> Limit:
    """Return the limit with both ends written."""
    usual = RANGE[format_]
    return filled(limit, {"lower": usual.lower, "upper": usual.upper})


def direction(axis: Axis | None, format_: Format) -> Vector3:
    """Return where an axis points, in the frame that it is expressed in."""
    return (axis.xyz if axis else None) or AXIS[format_]


def multiplier(mimic: Mimic | None) -> float:
    """Return how far a joint turns for each radian of the joint that it mimics."""
    return MULTIPLIER if mimic is None or mimic.multiplier is None else mimic.multiplier


def sizes(shape: ShapeNode) -> tuple[float, ...]:
    """Return the lengths of a shape in m: x, y, z, or the radius and then the length."""
    found: list[float] = []
    for name, usual in SIZES[type(shape)].items():
        written: float | Vector3 | None = getattr(shape, name)
        value = usual if written is None else written
        found += value if isinstance(value, tuple) else (value,)
    return tuple(found)
