"""Annotations of names that a conversion had to change, which give them back.

    <tf:name instead_of="arm_joint">arm</tf:name>
    <tf:name instead_of="arm" was="arm "/>             where blanks are around the name

An annotation has the name that it was made for: where that was edited since, the edit counts.
"""

from typing import Any

from twinform.ir import Collision, Element, Frame, Joint, Light, Link, Model, Opaque, Sensor, Visual, World
from twinform.ir.scopes import SCOPE
from twinform.passes.carriers.annotations import AnyNode, annotation, find_annotation

NAME = "name"
"""The annotation on a link, joint, frame or shape with the name that it had in the source."""


def source_name(node: World | Model | Link | Joint | Frame | Collision | Visual | Light | Sensor) -> str:
    """The name that a part had in the source, where it could not be kept: the annotated one, or else its own."""
    found = find_annotation(node, NAME)
    return annotated_name(found) if found and found.get("instead_of") == node.name else node.name or ""


def scoped_source_name(node: Link | Joint | Frame) -> str:
    """The name that a part of a flattened model had in the source, with its scope, which annotations do not have."""
    scope, mark, own = node.name.rpartition(SCOPE)
    return scope + mark + source_name(node.copy(name=own))


def annotated_name(found: Element) -> str:
    """The name that an annotation gives back."""
    return found.get("was") or found.text or ""


def with_old_name(node: AnyNode, name: str) -> AnyNode:
    """The node with an annotation of its name, before it is renamed."""
    old: Any = getattr(node, "name", None)
    return node.copy(opaque=(old_name(old, name), *node.opaque))


def old_name(old: str, name: str) -> Opaque:
    """The annotation of the name that a part had before this one; blanks around it need an attribute."""
    is_plain = old == old.strip()
    return annotation(NAME, old if old and is_plain else None, {"instead_of": name, "was": None if is_plain else old})
