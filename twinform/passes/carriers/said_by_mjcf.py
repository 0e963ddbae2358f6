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
    Inertia,
    Inertial,
    Joint,
    Light,
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

_NONE: frozenset[str] = frozenset()


def said_by_mjcf(node: Node) -> frozenset[str] | None:
    """The fields of a node that MJCF says; None where it says nothing of it."""
    found = _SAID.get(type(node))
    return found(node) if callable(found) else found


def _of_shape(node: Node) -> frozenset[str] | None:
    shape = node.geometry.shape if isinstance(node, Visual | Collision) and node.geometry else None
    return _fields("name pose") if shape is not None and type(shape) in _SHAPES else None


def _of_inertial(node: Node) -> frozenset[str] | None:
    is_written = isinstance(node, Inertial) and not node.auto and node.mass is not None
    return _fields("pose mass") if is_written else None


def _of_joint(node: Node) -> frozenset[str] | None:
    if not isinstance(node, Joint):
        return None
    if node.type == "fixed":  # a body in a body, without a joint that could have a name
        return frozenset({"name", "parent"})
    return _fields("name parent child pose")


def _fields(names: str) -> frozenset[str]:
    return frozenset(names.split())


_SHAPES: Mapping[type[Node], frozenset[str]] = {
    Box: _fields("size"),
    Capsule: _fields("radius length"),
    Cylinder: _fields("radius length"),
    Ellipsoid: _fields("radii"),
    Mesh: _fields("uri scale"),
    Plane: _fields("normal size"),
    Sphere: _fields("radius"),
}
_SAID: Mapping[type[Node], frozenset[str] | Callable[[Node], frozenset[str] | None]] = {
    **_SHAPES,
    Model: _fields("name pose links joints frames models"),
    World: _fields("name gravity models joints frames"),
    Document: _fields("name format version namespaces"),
    Link: _fields("name pose"),
    Inertial: _of_inertial,
    Inertia: _fields("ixx ixy ixz iyy iyz izz"),
    Visual: _of_shape,
    Collision: _of_shape,
    Geometry: _NONE,
    Material: _fields("diffuse"),
    Surface: _fields("mu"),
    Joint: _of_joint,
    Axis: _fields("xyz"),
    Limit: _fields("lower upper effort"),
    Dynamics: _fields("damping friction spring_reference spring_stiffness"),
    Mimic: _fields("joint multiplier offset"),
    Frame: _fields("name attached_to pose"),
    Light: _NONE,
}
