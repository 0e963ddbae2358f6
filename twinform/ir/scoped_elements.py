"""Elements without a type whose `name` has `::`, for which libsdformat refuses a whole file since SDF 1.8.

It looks at the `name` of every element, whether it knows the element or not, but for those in plugins and those with a
prefix: seen in libsdformat 12, which `tests/oracles/test_libsdformat.py` asks.
"""

from collections.abc import Iterator

from twinform.ir.census import PLAIN, census_of
from twinform.ir.element import Element, Opaque
from twinform.ir.node import Node
from twinform.ir.plugin import Plugin
from twinform.ir.scopes import SCOPE
from twinform.ir.tree_walks import children_of

_PLUGIN = "plugin"


def scoped_elements(element: Element) -> Iterator[Element]:
    """The element and those in it that libsdformat refuses for their names."""
    if element.name == _PLUGIN or ":" in element.name:
        return
    if SCOPE in (element.get("name") or ""):
        yield element
    for child in element.children:
        yield from scoped_elements(child)


def scoped_parts(node: Node) -> tuple[Opaque, ...]:
    """The opaque parts of a node in which there are such elements; plugins may have them."""
    if not node.opaque or isinstance(node, Plugin):
        return ()
    return tuple(part for part in node.opaque if part.element and any(scoped_elements(part.element)))


def scoped_parts_below(node: Node) -> Iterator[Opaque]:
    """Yield the scoped untyped parts of a node and of all nodes inside it."""
    stack = [node]
    while stack:
        node = stack.pop()
        if census_of(node) & PLAIN:
            yield from scoped_parts(node)
            stack += reversed([*children_of(node)])
