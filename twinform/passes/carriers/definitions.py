"""The definition in the SDF facts table that applies to the children of a node's element."""

from twinform.ir import (
    Collision,
    Document,
    Empty,
    Frame,
    Geometry,
    Include,
    Inertial,
    Joint,
    Light,
    Link,
    Material,
    Model,
    Node,
    Plugin,
    Pose,
    Sensor,
    Surface,
    Visual,
    World,
)

_DEFINITIONS: dict[type[Node], str] = {
    Document: "sdf",
    **{
        kind: kind.__name__.lower()
        for kind in (
            Collision, Frame, Geometry, Include, Inertial, Joint, Light, Link, Material, Model, Plugin, Pose,
            Sensor, Surface, Visual, World,
        )
    },
}  # fmt: skip


def definition_of(node: Node) -> str | None:
    """The definition of a node; None for one that only a row of another definition describes, such as a limit."""
    kind = node.__dict__.get("kind")
    if kind is not None:
        return None if isinstance(node, Empty) else f"{kind}_shape"
    return _DEFINITIONS.get(type(node))
