"""The definition in the SDF facts table that applies to the children of a node's element."""

from collections.abc import Mapping
from functools import cache

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
    Opaque,
    Plugin,
    Pose,
    Sensor,
    Surface,
    Visual,
    World,
)
from twinform.ir.record import field_value
from twinform.schemas import table

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
    kind = getattr(node, "kind", None)
    if kind is not None:
        return None if isinstance(node, Empty) else f"{kind}_shape"
    return _DEFINITIONS.get(type(node))


def is_repeated(part: Opaque, node: Node) -> bool:
    """Whether a part repeats an element that may stand once, of which readers take the first."""
    element = part.element
    if element is None or part.at or not (element.children or element.attributes or element.text):
        return False
    return element.name in _single(definition_of(node))


def inside(node: Node, at: str) -> Node | None:
    """The single node at a path of elements below another one, such as the limit of a joint at `axis/limit`."""
    holder: object = node
    for step in filter(None, at.split("/")):
        holder = field_value(holder, step) if isinstance(holder, Node) else None
    return holder if isinstance(holder, Node) else None


def has_first(node: Node, name: str) -> bool:
    """Whether a node has the element that another one of this name repeats."""
    definition = definition_of(node)
    place = _single(definition).get(name) if definition else name
    if place:
        return field_value(node, place) is not None
    return any(part.element.name == name for part in node.opaque if part.element)


@cache
def _single(definition: str | None) -> Mapping[str, str]:
    """The children of a definition that may stand once and have a typed form, with the fields that hold them."""
    rows = table("sdf").definitions[definition].children if definition else ()
    return {row.name: row.place.partition(".")[0] for row in rows if row.place and not row.repeats}
