"""Comparison of documents without carriers and without the order of elements where it has no meaning."""

from typing import TypeVar

from twinform.ir import Element, Node, Opaque, node_fields, rewrite
from twinform.ir.record import field_values, fields_of
from twinform.passes.carriers.removal import without_parts
from twinform.passes.carriers.sdf_versions import carried, is_version_carrier

AnyNode = TypeVar("AnyNode", bound=Node)


def without_carriers(node: AnyNode) -> AnyNode:
    """The node without carriers of other versions, all the way down."""
    return without_parts(node, is_version_carrier)


def comparable(node: AnyNode) -> AnyNode:
    """The node with unlike untyped parts in one order, whatever order they stand in, and without empty nodes."""
    return rewrite(node, Node, _comparable)


def _comparable(node: Node) -> Node:
    if len(node.opaque) > 1 or any(part.element for part in node.opaque):
        parts = sorted((_sorted(part) for part in node.opaque), key=_place)
        node = node.copy(opaque=tuple(parts))
    empty = [name for name in node_fields(type(node)) if _is_empty(getattr(node, name))]
    return node.copy(**dict.fromkeys(empty)) if empty else node


def _is_empty(value: object) -> bool:
    """Whether it is a node of which nothing would be written."""
    if not isinstance(value, Node):
        return False
    fields = fields_of(type(value))
    return all(each == fields[name].default for name, each in field_values(value).items())


def _place(part: Opaque) -> tuple[str, ...]:
    """Where a part goes: by its own name, or by that of what it carries."""
    if not is_version_carrier(part):
        return (part.at, part.name, "", "")
    written = part.element.get("at") if part.element else None
    return (part.at, part.name, written or "", " ".join(piece.name for piece in carried(part)))


def _sorted(part: Opaque) -> Opaque:
    return part if part.element is None else part.copy(element=_sorted_element(part.element))


def _sorted_element(element: Element) -> Element:
    attributes = tuple(sorted(element.attributes))
    if element.name == "plugin":  # only it knows what its order means
        return element.copy(attributes=attributes)
    children = sorted(map(_sorted_element, element.children), key=lambda child: child.name)
    return element.copy(attributes=attributes, children=tuple(children))


def same(one: Node, other: Node) -> bool:
    """Whether two nodes say the same; something that is not a number is like itself here."""
    one, other = comparable(one), comparable(other)
    # A NaN is not equal to itself, but it has the same text.
    return one == other or one.model_dump_json() == other.model_dump_json()
