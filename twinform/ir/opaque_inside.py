"""Whether anything untyped is inside a node, found once for each: most passes that look for it need not walk there."""

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from twinform.ir.extension import GazeboExtension
from twinform.ir.node import Node
from twinform.ir.tree import node_fields, node_values

AnyNode = TypeVar("AnyNode", bound=Node)

_SLOT: Any = Node.__dict__["_holds_opaque"]
"""Where a node keeps what was found; asked for in the usual way, pydantic would look for an unset one in vain."""


def holds_opaque(node: Node) -> bool:
    """Whether a node, or one inside it, has opaque parts or the untyped content of a `<gazebo>` element."""
    if node.opaque:
        return True
    fields = node_fields(type(node))
    if not fields:  # most nodes are poses and shapes, for which nothing need be remembered
        return isinstance(node, GazeboExtension)
    try:
        return _SLOT.__get__(node)
    except AttributeError:
        found = _is_inside(node.__dict__, fields)
        _SLOT.__set__(node, found)
        return found


def _is_inside(values: Mapping[str, Any], fields: tuple[str, ...]) -> bool:
    for name in fields:
        value: Node | tuple[Node, ...] | None = values[name]
        if isinstance(value, Node):
            if holds_opaque(value):
                return True
        elif value and any(map(holds_opaque, value)):
            return True
    return False


def map_opaque(node: AnyNode, change: Callable[[Node], Node]) -> AnyNode:
    """The node with every node below it that holds opaque parts changed, from the inside out; `node` itself is not."""
    update: dict[str, Any] = {}
    for name, value in node_values(node):
        if isinstance(value, Node):
            changed = _changed(value, change)
            if changed is not value:
                update[name] = changed
        else:
            many = tuple([_changed(one, change) for one in value])
            if any(new is not old for new, old in zip(many, value, strict=True)):
                update[name] = many
    return node.model_copy(update=update) if update else node


def _changed(node: Node, change: Callable[[Node], Node]) -> Node:
    return change(map_opaque(node, change)) if holds_opaque(node) else node
