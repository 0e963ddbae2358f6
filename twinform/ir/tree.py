"""Walking and rebuilding trees of nodes."""

from collections.abc import Callable, Iterator
from functools import cache
from typing import Any, Self, TypeVar, get_args

from twinform.ir.element import Element, Opaque
from twinform.ir.node import Node

AnyNode = TypeVar("AnyNode", bound=Node)
Wanted = TypeVar("Wanted", bound=Node)

_ABOUT = frozenset({"source", "spelling", "namespaces", "format", "kind", "version"})


@cache
def node_fields(kind: type[Node]) -> tuple[str, ...]:
    """The fields of a class of nodes that may hold nodes."""
    return tuple(name for name, field in kind.model_fields.items() if _holds_nodes(field.annotation))


def _holds_nodes(annotation: Any) -> bool:
    if isinstance(annotation, type):
        return issubclass(annotation, Node)
    return annotation is Self or any(map(_holds_nodes, get_args(annotation)))


def node_values(node: Node) -> Iterator[tuple[str, Node | tuple[Node, ...]]]:
    """The fields of a node that hold nodes, each with the one or the several in it."""
    values = node.__dict__
    for name in node_fields(type(node)):
        value = values[name]
        if value:
            yield name, value


def children_of(node: Node) -> Iterator[Node]:
    """The nodes directly inside a node, in the order of its fields."""
    values = node.__dict__
    for name in node_fields(type(node)):
        value = values[name]
        if isinstance(value, Node):
            yield value
        elif value:
            yield from value


def walk(node: Node) -> Iterator[Node]:
    """A node and all nodes inside it, from the outside in."""
    stack = [node]
    while stack:
        current = stack.pop()
        yield current
        if inside := [*children_of(current)]:
            inside.reverse()
            stack += inside


def map_children(node: AnyNode, change: Callable[[Node], Node]) -> AnyNode:
    """The node with each node directly inside it changed; the same object where nothing changes."""
    values = node.__dict__
    update: dict[str, Any] = {}
    for name in node_fields(type(node)):
        value = values[name]
        if isinstance(value, Node):
            changed = change(value)
            if changed is not value:
                update[name] = changed
        elif value:
            many = tuple([change(one) for one in value])
            if any(new is not old for new, old in zip(many, value, strict=True)):
                update[name] = many
    return node.model_copy(update=update) if update else node


@cache
def fields_towards(kind: type[Node], wanted: type[Node]) -> tuple[str, ...]:
    """The fields of a class of nodes in which, at any depth, a node of another class may be."""
    return tuple(name for name in node_fields(kind) if any(issubclass(each, wanted) for each in _inside(kind, name)))


def _inside(kind: type[Node], field: str) -> set[type[Node]]:
    """The classes of the nodes that may be in a field, and in those."""
    found: set[type[Node]] = set()
    fresh = set(_kinds(kind.model_fields[field].annotation, kind))
    while fresh:
        found |= fresh
        below = ((each, name) for each in fresh for name in node_fields(each))
        fresh = {one for each, name in below for one in _kinds(each.model_fields[name].annotation, each)} - found
    return found


def _kinds(annotation: Any, own: type[Node]) -> Iterator[type[Node]]:
    if annotation is Self:
        yield own
    elif isinstance(annotation, type):
        if issubclass(annotation, Node):
            yield annotation
    else:
        for each in get_args(annotation):
            yield from _kinds(each, own)


def map_kind(node: AnyNode, wanted: type[Wanted], change: Callable[[Wanted], Node]) -> AnyNode:
    """The node with every node of a class below it changed, from the inside out; `node` itself is not.

    It looks only where such a node may be.
    """
    values = node.__dict__
    update: dict[str, Any] = {}
    for name in fields_towards(type(node), wanted):
        value = values[name]
        if isinstance(value, Node):
            changed = _of_kind(value, wanted, change)
            if changed is not value:
                update[name] = changed
        elif value:
            many = tuple([_of_kind(one, wanted, change) for one in value])
            if any(new is not old for new, old in zip(many, value, strict=True)):
                update[name] = many
    return node.model_copy(update=update) if update else node


def _of_kind(node: Node, wanted: type[Wanted], change: Callable[[Wanted], Node]) -> Node:
    node = map_kind(node, wanted, change)
    return change(node) if isinstance(node, wanted) else node


def count_parts(node: Node) -> int:
    """How many facts a node states: one for each node, written value, and opaque element or attribute."""
    return sum(1 + _count_values(one) for one in walk(node))


def _count_values(node: Node) -> int:
    return sum(_weight(value) for name, value in node.__dict__.items() if name not in _ABOUT)


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
