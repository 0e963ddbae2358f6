"""Makes nodes of the IR from the values that were read for them."""

from collections.abc import Mapping
from dataclasses import MISSING
from typing import Any, Literal, get_args, get_origin

from twinform.ir import Node
from twinform.ir.record import fields_of, maker
from twinform.ir.tree_walks import classes_in

Data = dict[str, Any]
"""The values of a node by their fields, while it is read."""

_FORMAT = "format"
"""The one required field that no element gives: whoever reads a document knows it."""


class NodeMaker:
    """Makes nodes of one class.

    `inner` are the classes of nodes that no element of their own makes, by their fields. `gathers` is whether values
    have to be completed before a node is made, even where nothing of it is opaque.
    """

    def __init__(self, kind: type[Node], inner: Mapping[str, type[Node]]) -> None:
        self._tuples = [name for name, each in fields_of(kind).items() if each.default == ()]
        self._inner = [(name, NodeMaker(each, {})) for name, each in inner.items()]
        self.gathers = len(self._tuples) > 1 or bool(inner)
        self.make = maker(kind)

    def complete(self, data: Data) -> None:
        """Make tuples of what was gathered in lists, and nodes of what was gathered in dicts."""
        for name in self._tuples:
            if name in data:
                data[name] = tuple(data[name])
        for name, inner in self._inner:
            if name in data:
                inner.complete(data[name])
                data[name] = inner.make(data[name])


def required_words(kind: type[Node]) -> Mapping[str, tuple[str, ...]]:
    """The fields without which there is no node of a class, with the words of those that take only some."""
    return {
        name: get_args(each.type) if get_origin(each.type) is Literal else ()
        for name, each in fields_of(kind).items()
        if each.default is MISSING and name != _FORMAT
    }


def node_class(holder: type[Node], field: str, kind: str | None = None) -> type[Node]:
    """The class of the nodes in a field, which is that of a kind where there are several.

    Raises:
        ValueError: there is no such field, or it does not hold nodes of one class.
    """
    require_place(holder, field)
    found = [each for each in classes_in(holder, field) if kind in {None, _kind(each)}]
    if len(found) != 1:
        raise ValueError(f"{holder.__name__}.{field} does not hold nodes of one class")
    return found[0]


def require_place(holder: type[Node], place: str) -> None:
    """Make sure that the place of a row is a field of the class that the row fills, or of a node in that.

    Raises:
        ValueError: it is not.
    """
    steps = place.removeprefix("/").split(".")
    for step in filter(None, steps):
        if step not in fields_of(holder):
            raise ValueError(f"{holder.__name__} has no field {step!r}")
        if step != steps[-1]:
            (holder,) = classes_in(holder, step)


def _kind(node: type[Node]) -> object:
    return fields_of(node)["kind"].default if "kind" in fields_of(node) else None
