"""What MJCF says of the nodes of SDF: the fields of each class that are written as its elements and attributes.

The writer writes them, and carriers hold all others. A condition says where MJCF has nothing for a node of a class,
such as for a cone; then the whole node is carried.
"""

from collections.abc import Callable, Mapping
from typing import Any

from twinform.ir import (
    Axis,
    Box,
    Capsule,
    Collision,
    Cylinder,
    Document,
    Dynamics,
    Ellipsoid,
    Frame,
    Geometry,
    Heightmap,
    Inertia,
    Inertial,
    Joint,
    Limit,
    Link,
    Material,
    Mesh,
    Mimic,
    Model,
    Node,
    Plane,
    Sphere,
    Surface,
    Visual,
    World,
)
from twinform.ir.defaults import UNLIMITED
from twinform.passes.carriers.token_mass import is_chain_token, is_token

_NONE: frozenset[str] = frozenset()


def said_by_mjcf(node: Node) -> frozenset[str] | None:
    """The fields of a node that MJCF says, wherever it is; None where it says nothing of it."""
    found = _SAID.get(type(node))
    return found(node) if callable(found) else found


def said_of_limit(limit: Limit, joint: Joint) -> frozenset[str]:
    """The fields of the limit of a joint that MJCF says: what is no limit has no words there.

    A joint that can only be at one position has a narrow range instead.
    """
    found: set[str] = set()
    if joint.type in LIMITED and limit.lower != limit.upper and not _is_reversed(limit):
        found |= {"lower", "upper"}
    if joint.type not in _ROUND and limit.effort is not None and 0.0 < limit.effort < UNLIMITED:
        found.add("effort")
    return frozenset(found)


LIMITED = frozenset({"revolute", "prismatic", "universal", "revolute2", "screw"})
"""The types of joints that are written with a range."""
_ROUND = frozenset({"ball", "spherical"})
"""The types of joints without an axis, which are written without an effort too."""


def _is_reversed(limit: Limit) -> bool:
    return limit.lower is not None and limit.upper is not None and limit.lower > limit.upper


def _of_link(node: Link) -> frozenset[str]:
    return _WEIGHTLESS if node.gravity is False else _PLACED


def _of_shape(node: Visual | Collision) -> frozenset[str] | None:
    return _PLACED if node.geometry else None


def _of_geometry(node: Geometry) -> frozenset[str]:
    """Whether a shape is one of MJCF; what a mesh stands for is restored by a note on the visual or collision."""
    return _NONE if node.shape is None or type(node.shape) in _SHAPES else _SHAPE


def _of_inertial(node: Inertial) -> frozenset[str] | None:
    return None if node.auto or is_token(node) or is_chain_token(node) else _MASS


def _of_material(node: Material) -> frozenset[str] | None:
    """Whether a material is a color and no more; any other one is taken whole while the file shows the same look."""
    color = node.diffuse
    if color is None or len(color) != _WITH_ALPHA or not all(0.0 <= part <= 1.0 for part in color):
        return None
    return _COLORS if node == Material.unchecked(ambient=color, diffuse=color) else None


_WITH_ALPHA = 4


def _of_joint(node: Joint) -> frozenset[str]:
    return _FIXED if node.type == "fixed" else _HELD  # a body in a body, without a joint that could have a name


def _of_mimic(node: Mimic) -> frozenset[str] | None:
    """Whether a mimic is a polynomial as it is; one with a reference is taken whole while it agrees with that."""
    return None if node.reference else _POLYNOMIAL


def _of_dynamics(node: Dynamics) -> frozenset[str]:
    return _SPRING if node.spring_stiffness else _DAMPING


def _fields(names: str) -> frozenset[str]:
    return frozenset(names.split())


_COLORS = _fields("ambient diffuse")
_DAMPING = _fields("damping friction spring_stiffness")
_FIXED = _fields("name parent")
_HELD = _fields("name parent child pose")
_MASS = _fields("pose mass")
_PLACED = _fields("name pose")
_POLYNOMIAL = _fields("joint axis multiplier offset")
_SHAPE = _fields("shape")
_WEIGHTLESS = _PLACED | {"gravity"}
_SPRING = _DAMPING | {"spring_reference"}
_SHAPES: Mapping[type[Node], frozenset[str]] = {
    Box: _fields("size"),
    Capsule: _fields("radius length"),
    Cylinder: _fields("radius length"),
    Ellipsoid: _fields("radii"),
    Heightmap: _fields("uri"),
    Mesh: _fields("uri scale"),
    Plane: _fields("normal size"),
    Sphere: _fields("radius"),
}
_SAID: Mapping[type[Node], frozenset[str] | Callable[[Any], frozenset[str] | None]] = {
    **_SHAPES,
    Model: _fields("name pose links joints frames models"),
    World: _fields("name gravity models joints frames"),
    Document: _fields("name format version namespaces"),
    Link: _of_link,
    Inertial: _of_inertial,
    Inertia: _fields("ixx ixy ixz iyy iyz izz"),
    Visual: _of_shape,
    Collision: _of_shape,
    Geometry: _of_geometry,
    Material: _of_material,
    Surface: _fields("mu"),
    Joint: _of_joint,
    Axis: _fields("xyz"),
    Limit: _fields("lower upper effort"),
    Dynamics: _of_dynamics,
    Mimic: _of_mimic,
    Frame: _fields("name attached_to pose"),
}
