"""Repeated elements in partial nodes: `<tf:again><pose>0 0 2 0 0 0</pose></tf:again>`.

Of several elements that may stand once, readers take the first. Where a target says that one, a carrier holds the
others only, and these must not be taken for the first.
"""

from collections.abc import Mapping

from twinform.ir import Geometry, Node, Opaque, Pose
from twinform.ir.record import field_value, fields_of
from twinform.passes.carriers.annotations import AnyNode, annotation, is_annotation
from twinform.passes.carriers.carriers import is_ours

AGAIN = "again"
"""The annotation on a partial node with an element that repeats one of the whole node."""
_UNWRITTEN: Mapping[str, object] = {
    "pose": Pose.unchecked(xyz=(0.0, 0.0, 0.0), rpy=(0.0, 0.0, 0.0)),
    "multiplier": 1.0,
    "offset": 0.0,
}
"""Fields that a target leaves out where they say nothing; as the first of several elements they have to be there."""


def wrap_repeated(node: AnyNode) -> AnyNode:
    """The node with annotations around the elements in it that repeat one of its fields."""
    if not any(_repeats(part, node) for part in node.opaque):
        return node
    return node.copy(opaque=tuple(_wrapped(part) if _repeats(part, node) else part for part in node.opaque))


def unwrap_repeated(node: AnyNode) -> tuple[AnyNode, list[str]]:
    """The node with the elements that repeat one of its fields, and the names of those that repeat nothing any more."""
    notes = [part.element for part in node.opaque if part.element and is_annotation(part, AGAIN)]
    if not notes:
        return node, []
    firsts = (each.name for note in notes for each in note.children if each.name in _UNWRITTEN)
    update = {name: _UNWRITTEN[name] for name in firsts if field_value(node, name) is None}
    node = node.copy(**update) if update else node
    parts, gone = list[Opaque](), list[str]()
    for part in node.opaque:
        if part.element is None or not is_annotation(part, AGAIN):
            parts.append(part)
            continue
        for child in part.element.children:
            bare = Opaque.unchecked(element=child)
            if _repeats(bare, node):
                parts.append(bare)
            else:
                gone.append(child.name)
    return node.copy(opaque=tuple(parts)), gone


def _wrapped(part: Opaque) -> Opaque:
    note = annotation(AGAIN)
    holder, element = note.element, part.element
    return part if holder is None or element is None else part.copy(element=holder.copy(children=(element,)))


def _repeats(part: Opaque, node: Node) -> bool:
    """Whether an untyped part repeats an element that a field of the node holds."""
    if part.element is None or part.at or is_ours(part):
        return False
    if isinstance(node, Geometry):
        return node.shape is not None
    return part.element.name in fields_of(type(node)) and field_value(node, part.element.name) is not None
