"""Merging two descriptions of one node, field by field."""

from collections.abc import Mapping
from typing import Any, TypeVar

from twinform.ir import Element, Node, Opaque
from twinform.ir.node import NOT_CONTENT
from twinform.ir.record import field_value
from twinform.ir.tree_walks import node_fields

AnyNode = TypeVar("AnyNode", bound=Node)

# Half of one inertia and half of another would be a body that nobody meant.
_WHOLE = frozenset({"inertial", "geometry", "pose", "surface"})
"""What makes sense only as it was written."""
REPLACING = frozenset({"material", "surface"})
"""Of these in `<visual>` and `<collision>` of `<gazebo>` libsdformat keeps the last (InsertSDFExtensionVisual)."""
_ONCE = frozenset({"physics"})
"""Elements without a typed form that may stand once."""


def merge(mine: AnyNode, fields: Mapping[str, Any], conflicts: list[str]) -> AnyNode:
    """The node with more fields. Of a field in both the first stays; `conflicts` gets its name."""
    update: dict[str, Any] = {}
    lists = node_fields(type(mine))
    for field, value in fields.items():
        old = field_value(mine, field)
        if field in NOT_CONTENT:
            continue
        if field == "opaque":
            update[field] = _join(mine.opaque, value)
        elif isinstance(old, tuple) and field in lists:
            update[field] = (*old, *value)
        elif old is None:
            update[field] = value
        elif isinstance(old, Node) and type(old) is type(value) and field not in _WHOLE:
            update[field] = merge(old, written(value), conflicts)
        elif old != value:
            conflicts.append(field)
    more: Mapping[str, str] = fields.get("spelling") or {}
    spelling = {**more, **(mine.spelling or {})}
    return mine.copy(**{**update, "spelling": spelling or None})


def written(node: Node) -> dict[str, Any]:
    """The fields that are written in a node, with how they are spelt and where they were read."""
    values = ((name, getattr(node, name)) for name in node.field_names)
    return {name: value for name, value in values if value is not None and value != ()}


def _join(mine: tuple[Opaque, ...], more: tuple[Opaque, ...]) -> tuple[Opaque, ...]:
    joined = list(mine)
    for part in more:
        once = part.element is not None and part.element.name in _ONCE
        place = next((i for i, old in enumerate(joined) if _is_the_same(old, part)), None) if once else None
        element = joined[place].element if place is not None else None
        if place is None or element is None or part.element is None:
            joined.append(part)
        else:
            joined[place] = joined[place].copy(element=merge_elements(element, part.element))
    return tuple(joined)


def _is_the_same(old: Opaque, new: Opaque) -> bool:
    if old.element is None or new.element is None or old.at != new.at:
        return False
    return old.element.name == new.element.name


def merge_elements(mine: Element, more: Element) -> Element:
    """The element with the children of another one that it lacks, all the way down."""
    children = list(mine.children)
    places = {child.name: place for place, child in reversed(list(enumerate(children)))}
    for child in more.children:
        if child.name not in places:
            places[child.name] = len(children)
            children.append(child)
        else:
            place = places[child.name]
            children[place] = merge_elements(children[place], child)
    return mine.copy(children=tuple(children))
