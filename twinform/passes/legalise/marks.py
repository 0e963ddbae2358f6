"""Marks on what a pass has made up, so that the way back can leave it out again."""

from typing import TypeVar

from twinform.ir import Node, Opaque, map_children
from twinform.passes.legalise.carrier import NAMESPACE

AnyNode = TypeVar("AnyNode", bound=Node)

MADE = f"{{{NAMESPACE}}}made"
"""The attribute that lists the fields of a node that were not in the source; `.` is the whole node."""


def mark_made(node: AnyNode, *fields: str) -> AnyNode:
    """The node with a mark on the fields that a pass has made up, so that the way back can leave them out again."""
    if "." in made_fields(node):
        return node
    rest = tuple(part for part in node.opaque if not _is_mark(part))
    words = " ".join(dict.fromkeys((*made_fields(node), *fields)))
    return node.model_copy(update={"opaque": (Opaque(attribute=(MADE, words)), *rest)}) if words else node


def made_fields(node: Node) -> tuple[str, ...]:
    """The fields that a pass has made up."""
    found = (part.attribute[1] for part in node.opaque if part.attribute is not None and _is_mark(part))
    return tuple(" ".join(found).split())


def without_mark(node: AnyNode, field: str) -> AnyNode:
    """The node without the mark on one field."""
    fields = [each for each in made_fields(node) if each != field]
    rest = tuple(part for part in node.opaque if not _is_mark(part))
    bare = node.model_copy(update={"opaque": rest})
    return mark_made(bare, *fields) if fields else bare


def _is_mark(part: Opaque) -> bool:
    return part.attribute is not None and part.attribute[0] == MADE


def without_marks(node: AnyNode) -> AnyNode:
    """The node without the marks of the passes, on it and in it."""
    kept = tuple(part for part in node.opaque if not _is_mark(part))
    if len(kept) != len(node.opaque):
        node = node.model_copy(update={"opaque": kept})
    return map_children(node, without_marks)
