"""Removes elements from a tree of nodes by what they are: carriers, or all that other readers skip."""

from collections.abc import Callable
from functools import partial
from typing import TypeVar

from twinform.ir import OPAQUE, Element, GazeboExtension, Model, Node, Opaque, replace_fields, rewrite
from twinform.passes.carriers.carriers import is_ours

AnyNode = TypeVar("AnyNode", bound=Node)
Unwanted = Callable[[Opaque], bool]
_BODIES = frozenset({"frame", "joint", "link", "model"})
"""What `<gazebo>` adds to a robot: readers of URDF other than Gazebo's do not look into it."""


def without_ours(node: AnyNode) -> AnyNode:
    """The node without carriers and annotations: what every other reader sees."""
    return without_parts(node, is_ours)


def without_bodies_for_gazebo(node: AnyNode) -> AnyNode:
    """The node without the links, joints and frames that only Gazebo adds to a robot of URDF."""
    return rewrite(node, Model, _without_bodies)


def _without_bodies(model: Model) -> Model:
    extensions = ((each, _without_bodies_in(each)) for each in model.extensions)
    kept = tuple(left for each, left in extensions if left.content or not each.content)
    return replace_fields(model, extensions=kept)


def _without_bodies_in(extension: GazeboExtension) -> GazeboExtension:
    if extension.reference is not None:
        return extension
    return replace_fields(extension, content=tuple(one for one in extension.content if one.name not in _BODIES))


def without_parts(node: AnyNode, unwanted: Unwanted) -> AnyNode:
    """The node without some untyped parts, also in the untyped parts of all below."""
    return rewrite(node, Node, partial(_without_parts, unwanted), having=OPAQUE)


def _without_parts(unwanted: Unwanted, node: Node) -> Node:
    bare = partial(_bare_element, unwanted)
    kept = (part for part in node.opaque if not unwanted(part))
    opaque = tuple(replace_fields(part, element=bare(part.element)) if part.element else part for part in kept)
    if isinstance(node, GazeboExtension):
        return replace_fields(node, opaque=opaque, content=_bare_elements(unwanted, node.content))
    return replace_fields(node, opaque=opaque)


def _bare_element(unwanted: Unwanted, element: Element) -> Element:
    return replace_fields(element, children=_bare_elements(unwanted, element.children))


def _bare_elements(unwanted: Unwanted, elements: tuple[Element, ...]) -> tuple[Element, ...]:
    kept = (each for each in elements if not unwanted(Opaque.unchecked(element=each)))
    return tuple(_bare_element(unwanted, each) for each in kept)
