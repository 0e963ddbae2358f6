"""The definition in the SDF facts table that applies to the children of a node's element."""

from collections.abc import Iterator, Mapping
from functools import cache

from twinform.ir import (
    Collision,
    Document,
    Element,
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
from twinform.schemas import Fact, table

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
    """The definition of a node; None for a node, such as a limit, that is a row of another definition."""
    kind = getattr(node, "kind", None)
    if kind is not None:
        return None if isinstance(node, Empty) else f"{kind}_shape"
    return _DEFINITIONS.get(type(node))


def is_repeated(part: Opaque, node: Node) -> bool:
    """Whether a part repeats an element that may stand once; readers take the first one."""
    element = part.element
    if element is None or part.at or not (element.children or element.attributes or element.text):
        return False
    definition = definition_of(node)
    return element.name in _single(definition) and not _is_untyped(element, definition)


def _is_untyped(element: Element, definition: str | None) -> bool:
    """Whether the reader makes no fields of an element, since it holds several where readers take the last."""
    rows = table("sdf").definitions[definition].children if definition else ()
    last = {inner.name for row in rows if row.name == element.name for inner in row.rows if inner.last}
    names = [child.name for child in element.children if child.name in last]
    return len(names) > len({*names})


def inside(node: Node, at: str) -> Node | None:
    """The single node at a path of elements below another one, such as the limit of a joint at `axis/limit`."""
    holder: object = node
    for step in filter(None, at.split("/")):
        if isinstance(holder, Geometry):
            holder = holder.shape if holder.shape and holder.shape.kind == step else None
        else:
            holder = field_value(holder, step) if isinstance(holder, Node) else None
    return holder if isinstance(holder, Node) else None


def has_first(node: Node, name: str) -> bool:
    """Whether a node has a first element of this name, in a field or as an opaque part."""
    definition = definition_of(node)
    places = _single(definition).get(name, ()) if definition else (name,)
    if any(field_value(node, place) is not None for place in places):
        return True
    return any(name == (part.at.partition("/")[0] or part.element.name) for part in node.opaque if part.element)


@cache
def _single(definition: str | None) -> Mapping[str, tuple[str, ...]]:
    """The children of a definition that may stand once and have a typed form, with the fields that hold them."""
    rows = table("sdf").definitions[definition].children if definition else ()
    return {row.name: tuple(_fields_of(row)) for row in rows if row.place and not row.repeats}


def _fields_of(row: Fact) -> Iterator[str]:
    """The field that holds an element, or the fields that hold what is in it."""
    if row.place == ".":
        for each in row.rows:
            yield from _fields_of(each)
    elif row.place:
        yield row.place.partition(".")[0]
