"""Rewriting a tree of nodes. What a change leaves alone stays the same object: a whole tree, or each part of one."""

from collections.abc import Callable
from functools import cache, partial
from operator import is_
from typing import Any, TypeVar

from twinform.ir.census import ANYTHING, bits_of, census_of
from twinform.ir.node import Node
from twinform.ir.sourced import Sourced
from twinform.ir.tree_walks import classes_below, classes_in, node_fields

AnyPart = TypeVar("AnyPart", bound=Sourced)
AnyNode = TypeVar("AnyNode", bound=Node)
Wanted = TypeVar("Wanted", bound=Node)


# One class at a time: a mapping `{Joint: f, Link: g}` cannot be typed so that each handler takes
# what its key is, and a visitor finds its methods by names that no checker reads. Of some forty
# callers three had two classes.
def rewrite(
    node: AnyNode,
    kind: type[Wanted],
    change: Callable[[Wanted], Wanted],
    *,
    having: int | None = None,
) -> AnyNode:
    """The node with every node of a class changed, in it and then itself: from the inside out, in the order of fields.

    So `change` sees a node in which all is changed already. A node without any of the bits `having` in its census stays
    as it is, with all that is in it; where none are given, those of the class are meant.
    """
    if having is None:
        having = ANYTHING if kind is Node else bits_of(kind)
    return _rewritten(kind, change, having, node)


def _rewritten(kind: type[Node], change: Callable[[Any], Node], having: int, node: Node) -> Any:
    if not census_of(node) & having:
        return node
    fields, is_wanted = _plan(type(node), kind)
    if fields:
        node = _with_changed(node, fields, partial(_rewritten, kind, change, having))
    return change(node) if is_wanted else node


def map_children(node: AnyNode, change: Callable[[Node], Node]) -> AnyNode:
    """The node with each node directly in it changed; it is for `change` to look further down."""
    return _with_changed(node, node_fields(type(node)), change)


def replace_node(node: AnyNode, old: Wanted, new: Wanted) -> AnyNode:
    """The node with one in it replaced by another; it is known by its identity, as equal nodes are still two."""
    return rewrite(node, type(old), lambda each: new if each is old else each)


def replace_fields(part: AnyPart, **fields: object) -> AnyPart:
    """The node or element with other values in some fields; itself where they hold the objects that are there."""
    update = {name: new for name, new in fields.items() if not _is_same(new, getattr(part, name))}
    return part.copy(**update) if update else part


def _is_same(new: Any, old: Any) -> bool:
    """Whether it is one object, or two tuples that hold the same objects."""
    if new is old:
        return True
    return new.__class__ is tuple is old.__class__ and len(new) == len(old) and all(map(is_, new, old))


def _with_changed(node: AnyNode, fields: tuple[str, ...], change: Callable[[Node], Node]) -> AnyNode:
    update: dict[str, Node | tuple[Node, ...]] = {}
    for name in fields:
        old: Node | tuple[Node, ...] | None = getattr(node, name)
        if not old:
            continue
        if isinstance(old, tuple):
            many = tuple([change(each) for each in old])
            if not all(map(is_, many, old)):
                update[name] = many
        elif (one := change(old)) is not old:
            update[name] = one
    return node.copy(**update) if update else node


@cache
def _plan(kind: type[Node], wanted: type[Node]) -> tuple[tuple[str, ...], bool]:
    """The fields in which a node of a class may hold, at any depth, one of another class; and whether it is one."""
    # A walk for joints never looks into links.
    return tuple(name for name in node_fields(kind) if _may_hold(kind, name, wanted)), issubclass(kind, wanted)


def _may_hold(kind: type[Node], field: str, wanted: type[Node]) -> bool:
    return any(issubclass(each, wanted) for inner in classes_in(kind, field) for each in classes_below(inner))
