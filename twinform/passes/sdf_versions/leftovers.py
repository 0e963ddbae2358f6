"""Removed elements and attributes of a node, as pieces for carriers."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import cast

from twinform.diagnostics import NOWHERE, Location
from twinform.ir import Element, Node, Opaque, count_parts
from twinform.ir.node import NOT_CONTENT
from twinform.ir.record import fields_of
from twinform.passes.carriers.carriers import to_element
from twinform.passes.carriers.definitions import definition_of
from twinform.passes.carriers.sdf_versions import VersionCondition

_ABOUT = NOT_CONTENT | {"name", "type", "kind", "format", "version", "namespaces"}
_IDENTITY = frozenset({"name", "type", "version"})


@dataclass(frozen=True, slots=True)
class Leftover:
    """A field's value, found by the fields from the node that carries it; or an untyped part, where there are none."""

    fields: tuple[str, ...]
    value: object
    condition: VersionCondition

    def inside(self, field: str, tag: str) -> "Leftover":
        """Return the leftover as seen from the node around it, which has this node in the element `tag`."""
        if isinstance(self.value, Opaque):
            at = f"{tag}/{self.value.at}" if self.value.at else tag
            return Leftover((), self.value.copy(at=at), self.condition)
        return Leftover((field, *self.fields), self.value, self.condition)

    @property
    def first(self) -> object:
        """The value, or the first of several; there is one where a field of several nodes lost one."""
        return cast("tuple[object, ...]", self.value)[0] if isinstance(self.value, tuple) else self.value

    @property
    def location(self) -> Location:
        """Where it was written, if it knows."""
        first = self.first
        return first.location if isinstance(first, Node | Opaque) else NOWHERE

    def called(self, pieces: list[Opaque]) -> str:
        """What to call it in a message."""
        names = [f"the attribute {piece.attribute[0]!r}" if piece.attribute else piece.name for piece in pieces]
        name = getattr(self.first, "name", None) if isinstance(self.first, Node) else None
        return " and ".join(dict.fromkeys(names)) + (f" {name!r}" if name else "")

    @property
    def weight(self) -> int:
        """How many elements and attributes it stands for."""
        first = self.first
        if isinstance(first, Opaque):
            return max(1, first.weight)
        return count_parts(first) if isinstance(first, Node) else 1


def node_pieces(node: Node, left: Leftover) -> list[Opaque]:
    """The pieces of a leftover of a node."""
    if isinstance(left.value, Opaque):
        return [left.value.copy(source=None)]
    bare = _with_only(node, left.fields, left.value)
    definition = definition_of(node) or ""
    return list(_pieces(to_element(bare, definition, "sdf"), "", len(left.fields) - 1))


def _with_only(node: Node, fields: tuple[str, ...], value: object) -> Node:
    first, *rest = fields
    inner = _with_only(getattr(node, first), tuple(rest), value) if rest else value
    # The writer makes the element: a node with nothing but the leftover is written, and what is in
    # that text is the piece.
    blank = {name: each.default for name, each in fields_of(type(node)).items() if name not in _ABOUT}
    return node.copy(**{**blank, first: inner})


def _pieces(element: Element, at: str, depth: int) -> Iterator[Opaque]:
    """Attributes and children of the element that is so far down; there is one on each step of the way."""
    if depth:
        child = element.children[0]
        yield from _pieces(child, f"{at}/{child.name}" if at else child.name, depth - 1)
        return
    for pair in element.attributes:
        if at or pair[0] not in _IDENTITY:
            yield Opaque.unchecked(at=at, attribute=pair)
    for child in element.children:
        yield Opaque.unchecked(at=at, element=child)
