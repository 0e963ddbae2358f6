"""What only MJCF has, kept in a node as `<tf:mjcf>`, merged into the element that is written for that node.

A joint that was read with an armature holds `<tf:mjcf><joint armature="0.1"/></tf:mjcf>`. Attributes that the written
element lacks are added, and children go behind its own; what the node says itself wins.
"""

from collections.abc import Sequence

from twinform.ir import Element, Node
from twinform.passes.carriers.carriers import NAMESPACE

KEPT = f"{{{NAMESPACE}}}mjcf"
ROOT = "mujoco"
"""The section by which a model or world says that it was read of MJCF: `<tf:mjcf><mujoco/></tf:mjcf>`."""


SINGLE = frozenset({"compiler", "option", "size", "visual", "statistic"})
"""Sections that are one element with attributes: what is added to them is merged."""


def kept_elements(node: Node) -> Sequence[Element]:
    """The elements of MJCF that a node keeps."""
    kept = [each.element for each in node.opaque if each.element is not None and each.element.name == KEPT]
    return [child for each in kept for child in each.children] if kept else ()


def with_kept(element: Element, node: Node) -> Element:
    """Return the element with what the node keeps of an element of this name."""
    if not node.opaque:
        return element
    for kept in kept_elements(node):
        if kept.name == element.name:
            element = merged(element, kept)
    return element


def merged(element: Element, kept: Element) -> Element:
    """Return an element with the attributes that it lacks and the children of one that was kept."""
    known = {key for key, _ in element.attributes}
    more = tuple(each for each in kept.attributes if each[0] not in known)
    return element.copy(attributes=(*element.attributes, *more), children=(*element.children, *kept.children))
