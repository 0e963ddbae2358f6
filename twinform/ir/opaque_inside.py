"""Whether a subtree has untyped parts: cached, so that passes which look for them skip the others."""

from collections.abc import Iterator
from typing import Any

from twinform.ir.element import Element
from twinform.ir.extension import GazeboExtension
from twinform.ir.node import Node
from twinform.ir.tree import children_of, node_fields

_SLOT: Any = Node.__dict__["_holds_opaque"]
"""Where a node keeps what was found; asked for in the usual way, pydantic would look for an unset one in vain."""


def holds_opaque(node: Node) -> bool:
    """Whether a node, or one inside it, has opaque parts or the untyped content of a `<gazebo>` element."""
    if node.opaque:
        return True
    if not node_fields(type(node)):  # most nodes are poses and shapes, for which nothing need be remembered
        return isinstance(node, GazeboExtension)
    try:
        return _SLOT.__get__(node)
    except AttributeError:
        found = any(map(holds_opaque, children_of(node)))
        _SLOT.__set__(node, found)
        return found


def untyped_elements(node: Node) -> Iterator[Element]:
    """Every element in the opaque parts and `<gazebo>` content of a node and of all inside it, and all in these."""
    if not holds_opaque(node):
        return
    own = (part.element for part in node.opaque if part.element)
    for element in (*own, *(node.content if isinstance(node, GazeboExtension) else ())):
        yield from element.walk()
    for child in children_of(node):
        yield from untyped_elements(child)
