"""How much a document says: its elements and attributes, counted over typed fields and opaque parts alike."""

from collections.abc import Iterator

from twinform.ir.element import Element, Opaque
from twinform.ir.node import Node

_ABOUT = frozenset({"source", "spelling", "namespaces", "format", "kind"})


def children_of(node: Node) -> Iterator[Node]:
    """The nodes directly inside a node, in the order of its fields."""
    for name, value in node.__dict__.items():
        if name in _ABOUT:
            continue
        for one in value if isinstance(value, tuple) else (value,):  # pyright: ignore[reportUnknownVariableType]
            if isinstance(one, Node):
                yield one


def walk(node: Node) -> Iterator[Node]:
    """A node and all nodes inside it, from the outside in."""
    stack = [node]
    while stack:
        current = stack.pop()
        yield current
        stack.extend(reversed(list(children_of(current))))


def count_parts(node: Node) -> int:
    """How many facts a node states: one for each node, written value, and opaque element or attribute."""
    return sum(1 + _count_values(one) for one in walk(node))


def _count_values(node: Node) -> int:
    count = 0
    for name, value in node.__dict__.items():
        if name in _ABOUT or value is None or isinstance(value, Node):
            continue
        count += _weight(value)
    return count


def _weight(value: object) -> int:
    if not isinstance(value, tuple):
        return 1
    if not value or isinstance(value[0], Node):
        return 0
    if isinstance(value[0], Element | Opaque):
        return sum(part.weight for part in value)  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
    return 1
