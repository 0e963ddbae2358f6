"""What MJCF says of the nodes of SDF: the fields of each class that are written as its elements and attributes.

The writer writes them, and carriers hold all others. A condition says where MJCF has nothing for a node of a class,
such as for a cone; then the whole node is carried.
"""

from collections.abc import Callable, Mapping

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


def _of_link(node: Node) -> frozenset[str]:
    return _WEIGHTLESS if isinstance(node, Link) and node.gravity is False else _PLACED


def _of_shape(node: Node) -> frozenset[str] | None:
    return _PLACED if isinstance(node, Visual | Collision) and node.geometry else None


def _of_geometry(node: Node) -> frozenset[str] | None:
    """Whether a shape is one of MJCF; what a mesh stands for is restored by a note on the visual or collision."""
    shape = node.shape if isinstance(node, Geometry) else None
    return _NONE if shape is None or type(shape) in _SHAPES else _SHAPE


def _of_inertial(node: Node) -> frozenset[str] | None:
    if not isinstance(node, Inertial) or node.auto or is_token(node) or is_chain_token(node):
        return None
    return _MASS


def _of_material(node: Node) -> frozenset[str] | None:
    """Whether a material is a color and no more; any other one is taken whole while the file shows the same look."""
    color = node.diffuse if isinstance(node, Material) else None
    if color is None or len(color) != _WITH_ALPHA or not all(0.0 <= part <= 1.0 for part in color):
        return None
    return _COLORS if node == Material.unchecked(ambient=color, diffuse=color) else None


_WITH_ALPHA = 4


def _of_joint(node: Node) -> frozenset[str] | None:
    if not isinstance(node, Joint):
        return None
    if node.type == "fixed":  # a body in a body, without a joint that could have a name
        return _FIXED
    return _HELD


def _of_mimic(node: Node) -> frozenset[str] | None:
    """Whether a mimic is a polynomial as it is; one with a reference is taken whole while it agrees with that."""
    has_reference = isinstance(node, Mimic) and bool(node.reference)
    return None if has_reference else _POLYNOMIAL


def _of_dynamics(node: Node) -> frozenset[str] | None:
    has_spring = isinstance(node, Dynamics) and bool(node.spring_stiffness)
    return _SPRING if has_spring else _DAMPING


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
_SAID: Mapping[type[Node], frozenset[str] | Callable[[Node], frozenset[str] | None]] = {
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
