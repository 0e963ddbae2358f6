"""Walking trees of nodes."""

from collections.abc import Iterator
from functools import cache
from typing import Any, Self, get_args

from twinform.ir.element import Element, Opaque
from twinform.ir.node import Node
from twinform.ir.record import field_values, fields_of

_ABOUT = frozenset({"namespaces", "format", "kind", "version"})


@cache
def node_fields(kind: type[Node]) -> tuple[str, ...]:
    """The fields of a class of nodes that may hold nodes."""
    return tuple(name for name in fields_of(kind) if classes_in(kind, name))


@cache
def classes_in(kind: type[Node], field: str) -> frozenset[type[Node]]:
    """The classes of the nodes that a field may hold."""
    return frozenset(_classes(fields_of(kind)[field].type, kind))


def _classes(annotation: Any, own: type[Node]) -> Iterator[type[Node]]:
    if annotation is Self:
        yield own
    elif not isinstance(annotation, type):
        for each in get_args(annotation):
            yield from _classes(each, own)
    elif issubclass(annotation, Node):
        yield annotation


@cache
def classes_below(kind: type[Node]) -> frozenset[type[Node]]:
    """Return a class of nodes with the classes of all nodes that may be inside it, at any depth."""
    found = {kind}
    queue = [kind]
    for each in queue:  # grows while it is walked
        fresh = {one for name in node_fields(each) for one in classes_in(each, name)} - found
        found |= fresh
        queue.extend(fresh)
    return frozenset(found)


def node_values(node: Node) -> Iterator[tuple[str, Node | tuple[Node, ...]]]:
    """Yield the fields of a node that hold nodes, each with its one or several nodes."""
    for name in node_fields(type(node)):
        value = getattr(node, name)
        if value:
            yield name, value


def children_of(node: Node) -> Iterator[Node]:
    """The nodes directly inside a node, in the order of its fields."""
    for name in node_fields(type(node)):
        value = getattr(node, name)
        if isinstance(value, tuple):
            yield from value
        elif value:
            yield value


def walk(node: Node) -> Iterator[Node]:
    """A node and all nodes inside it, from the outside in."""
    stack = [node]
    while stack:
        current = stack.pop()
        yield current
        if inside := [*children_of(current)]:
            inside.reverse()
            stack += inside


def count_parts(node: Node) -> int:
    """How many facts a node states: one for each node, written value, and opaque element or attribute."""
    return sum(1 + _count_values(one) for one in walk(node))


def _count_values(node: Node) -> int:
    return sum(_weight(value) for name, value in field_values(node).items() if name not in _ABOUT)


def _weight(value: object) -> int:
    if value is None or isinstance(value, Node):
        return 0
    if not isinstance(value, tuple):
        return 1
    parts: tuple[object, ...] = value  # pyright: ignore[reportUnknownVariableType]
    if not parts or isinstance(parts[0], Node):
        return 0
    if isinstance(parts[0], Element | Opaque):
        return sum(part.weight for part in parts if isinstance(part, Element | Opaque))
    return 1
