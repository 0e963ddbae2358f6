"""Small changes that make another robot of a model, each by its name: what a comparison must find."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

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
    Inertia,
    Inertial,
    Joint,
    Limit,
    Link,
    Material,
    Mesh,
    Node,
    Pose,
    Sphere,
    Visual,
    map_children,
)

AnyNode = TypeVar("AnyNode", bound=Node)
Change = Callable[[Any], Node | None]
"""A node after the change; None where it has nothing to change."""


def _set(**fields: object) -> Change:
    return lambda node: node.copy(**fields)


def _by(field: str, change: Callable[[Any], object]) -> Change:
    """Change a value that is written."""

    def apply(node: Any) -> Node | None:
        value = getattr(node, field)
        return None if value is None else node.copy(**{field: change(value)})

    return apply


def _pushed(node: Any) -> Node:
    pose = node.pose or Pose()
    x, y, z = pose.xyz or (0.0, 0.0, 0.0)
    return node.copy(pose=pose.copy(xyz=(x, y + 0.001, z)))


def _turned(node: Any) -> Node:
    pose = node.pose or Pose()
    roll, pitch, yaw = pose.rpy or (0.0, 0.0, 0.0)
    return node.copy(pose=pose.copy(rpy=(roll, pitch, yaw + 0.001)))


def _of_type(*types: str) -> Callable[[Joint], bool]:
    return lambda joint: joint.type in types


_MOVING = _of_type("revolute", "prismatic")
_TURNING = {"revolute": "prismatic", "prismatic": "revolute"}


def _other_type(joint: Joint) -> Joint | None:
    return joint.copy(type=_TURNING[joint.type]) if joint.type in _TURNING else None


def _in_axis(change: Change) -> Change:
    """A change of the axis of a joint that moves between limits."""

    def apply(joint: Joint) -> Node | None:
        axis = change(joint.axis) if _MOVING(joint) and joint.axis else None
        return joint.copy(axis=axis) if axis else None

    return apply


def _in_limit(field: str, step: float) -> Change:
    def apply(axis: Axis) -> Node | None:
        limit = axis.limit or Limit()
        value = getattr(limit, field)
        made = None if value is None else limit.copy(**{field: value + step})
        return axis.copy(limit=made) if made else None

    return _in_axis(apply)


def _in_dynamics(field: str) -> Change:
    def apply(axis: Axis) -> Node | None:
        dynamics = axis.dynamics or Dynamics()
        made = dynamics.copy(**{field: (getattr(dynamics, field) or 0.0) + 0.01})
        return axis.copy(dynamics=made)

    return _in_axis(apply)


def _skewed(axis: Axis) -> Axis:
    return axis.copy(xyz=(0.0, 0.6, 0.8))


def _heavier(inertia: Inertia) -> Inertia | None:
    return inertia.copy(izz=inertia.izz * (1 - 1e-6)) if inertia.izz else None


def _without(field: str) -> Change:
    return lambda node: node.copy(**{field: getattr(node, field)[1:]}) if getattr(node, field) else None


def _longer(size: tuple[float, ...]) -> tuple[float, ...]:
    return (size[0] * 1.0001, *size[1:])


def _fuller(value: float) -> float:
    return value * 1.0001


def _paler(color: tuple[float, ...]) -> tuple[float, ...]:
    return (color[0] * 0.5 + 0.1, *color[1:])


MUTATIONS: Mapping[str, tuple[type[Node], Change]] = {
    "mass": (Inertial, _by("mass", lambda mass: mass * 1.000001)),
    "an element of the inertia": (Inertia, _heavier),
    "a product of inertia": (
        Inertia,
        lambda node: node.copy(ixy=(node.ixy or 0.0) + node.ixx * 1e-6),
    ),
    "center of mass": (Inertial, _pushed),
    "joint type": (Joint, _other_type),
    "axis": (Joint, _in_axis(_skewed)),
    "lower limit": (Joint, _in_limit("lower", -0.001)),
    "upper limit": (Joint, _in_limit("upper", 0.001)),
    "effort limit": (Joint, _in_limit("effort", 0.5)),
    "velocity limit": (Joint, _in_limit("velocity", 0.5)),
    "damping": (Joint, _in_dynamics("damping")),
    "friction": (Joint, _in_dynamics("friction")),
    "place of a joint": (Joint, lambda joint: _pushed(joint) if joint.type != "floating" else None),
    "turn of a joint": (Joint, lambda joint: _turned(joint) if joint.type not in {"floating", "fixed"} else None),
    "place of a turning axis": (Joint, lambda joint: _pushed(joint) if joint.type == "revolute" else None),
    "place of a visual": (Visual, _pushed),
    "turn of a visual": (Visual, _turned),
    "place of a collision": (Collision, _pushed),
    "a visual too few": (Link, _without("visuals")),
    "a collision too few": (Link, _without("collisions")),
    "size of a box": (Box, _by("size", _longer)),
    "radius of a cylinder": (Cylinder, _by("radius", _fuller)),
    "length of a cylinder": (Cylinder, _by("length", _fuller)),
    "radius of a sphere": (Sphere, _by("radius", _fuller)),
    "radius of a capsule": (Capsule, _by("radius", _fuller)),
    "radii of an ellipsoid": (Ellipsoid, _by("radii", _longer)),
    "file of a mesh": (Mesh, _set(uri="package://p/other.stl")),
    "scale of a mesh": (Mesh, _set(scale=(0.001, 0.001, 0.0011))),
    "color": (Material, _by("color", _paler)),
    "gravity": (Link, lambda link: link.copy(gravity=not (link.gravity is not False))),
    "place of a frame": (Frame, _pushed),
    "turn of a frame": (Frame, _turned),
}
"""What kind of node is changed, and how; the first node that can be is."""
OF_SDF = frozenset({"gravity", "place of a frame", "turn of a frame", "radius of a capsule", "radii of an ellipsoid"})
"""What URDF has no element for."""
OF_URDF = frozenset({"color", "place of a joint", "turn of a joint"})
"""In SDF, links stay where they are when only their joint is written at another place."""


@dataclass(frozen=True, slots=True)
class Mutation:
    """One of `MUTATIONS`, to be called with a document."""

    name: str

    def __call__(self, document: Document) -> Document | None:
        """The document with one thing changed; None where it has nothing of the kind."""
        return mutate(document, self.name)


def mutate(document: Document, mutation: str) -> Document | None:
    """The document with one thing changed; None where it has nothing of the kind."""
    kind, change = MUTATIONS[mutation]
    done: list[Node] = []

    def visit(node: Node) -> Node:
        if done:
            return node
        if isinstance(node, kind) and (changed := change(node)) is not None and changed != node:
            done.append(changed)
            return changed
        return map_children(node, visit)

    mutated = map_children(document, visit)
    return mutated if done else None
