"""Partial nodes: what a target leaves unsaid of a node, and how it is merged into the node that comes back.

A partial node is of the class of the whole one and has its name, and none of the fields that the target says. Where
something of it is said, the rest belongs to what says it: such a node has the annotation `<tf:rest/>`, and is stale
where the target does not say the node any more. So an edit of the target always wins.
"""

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import field
from functools import cache
from itertools import count
from operator import is_
from typing import NamedTuple, Protocol, TypeVar, cast

from twinform.dataclass import dataclass
from twinform.ir import Axis, Dynamics, Limit, Node, Opaque, Surface, rewrite, walk
from twinform.ir.node import NOT_CONTENT, are_nodes
from twinform.ir.record import field_values, fields_of
from twinform.passes.carriers.annotations import annotation, find_annotation, is_annotation, without_annotation
from twinform.passes.carriers.carriers import is_carrier, is_ours

AnyNode = TypeVar("AnyNode", bound=Node)

REST = "rest"
"""The annotation on a partial node that belongs to a part of the target which says the other half."""
WRITTEN = "written"
"""The annotation on a partial node with the name that it has in the target: `<tf:written as="base_2"/>`."""
PLACE = "place"
"""The annotation on a partial node that the target has not, with its place among its like: `<tf:place index="0"/>`."""
IDENTITY = frozenset({"name", "type", "kind"})
"""Fields that a partial node has in common with the whole one, by which it is known."""
_APART = IDENTITY | NOT_CONTENT | {"opaque"}
EXISTENCE = "name"
"""Among the fields that are said it means that the target says of every such node that it is there."""
_LOOSE = (Axis, Dynamics, Limit, Surface)
"""Groups of values, of which each counts for itself: the others may go."""
_REST = annotation(REST)
_Usual = tuple[str, object]
"""A field and its default."""
Notes = Callable[[Node], tuple[Opaque, ...]]
"""Returns annotations on how the source wrote a node that the target writes otherwise."""


class Left(NamedTuple):
    """What a writer has left of a node, of which it says these fields as well."""

    node: Node
    fields: frozenset[str] = frozenset()


Said = Callable[[Node], frozenset[str] | Left | None]
"""Tells which fields of a node a target says; None where it says nothing of it, not even that it is there."""


def _no_notes(_node: Node) -> tuple[Opaque, ...]:
    return ()


def remainder(node: AnyNode, said: Said, notes: Notes = _no_notes) -> AnyNode | None:
    """The partial node with what a target leaves unsaid, and with the notes on it; None where it says everything."""
    fields = said(node)
    if fields is None:
        return rewrite(node, Node, lambda each: _with_notes(each, notes))
    base = node
    if isinstance(fields, Left):
        base, fields = cast("AnyNode", fields.node), fields.fields
    more = notes(node)
    update: dict[str, object] = {}
    is_said, has_content = base is not node or EXISTENCE in fields, bool(more or base.opaque)
    unsaid, known = _parts_of(base.__class__, fields)
    for name, usual in unsaid:
        value = getattr(base, name)
        if not value and (value is None or value == ()):  # as most are; to compare records takes longer
            continue
        left = _left_of(value, said, notes)
        if left is value:
            has_content = True
            continue
        is_said = True
        update[name] = usual if left is None else left
        has_content = has_content or left is not None
    if not has_content:  # most nodes are said as a whole, and need no copy
        return None
    for name, usual in known:
        if not _is_unwritten(getattr(base, name)):
            update[name] = usual
            is_said = True
    rest = (_REST,) if is_said and not isinstance(node, _LOOSE) else ()
    if rest or more:
        update["opaque"] = (*rest, *more, *base.opaque)
    return base.copy(**update) if update else base


def _with_notes(node: AnyNode, notes: Notes) -> AnyNode:
    more = notes(node)
    return node.copy(opaque=(*more, *node.opaque)) if more else node


def _left_of(value: object, said: Said, notes: Notes) -> object:
    """What is left of the value of a field that is not said as a whole; None where nothing is."""
    if isinstance(value, Node):
        return remainder(value, said, notes)
    if not are_nodes(value):
        return value
    made = tuple([left for each in value if (left := remainder(each, said, notes)) is not None])
    return value if len(made) == len(value) and all(map(is_, made, value)) else made or None


class Prepare(Protocol):
    """Changes a node of a file and the partial one, before they are merged."""

    def __call__(self, node: AnyNode, partial: AnyNode) -> tuple[AnyNode, AnyNode]:
        """Return both nodes."""
        ...


def _as_they_are(node: AnyNode, partial: AnyNode) -> tuple[AnyNode, AnyNode]:
    return node, partial


@dataclass(slots=True)
class Merging:
    """Merges partial nodes into the nodes of a document; `stale` are those that belong to nothing any more.

    `prepare` is asked for each pair first: which of the two gives way where both say one thing in two ways.
    """

    prepare: Prepare = _as_they_are
    stale: list[Node] = field(default_factory=list[Node])

    def merge(self, node: AnyNode, partial: AnyNode) -> AnyNode:
        """The node with the fields of a partial one that it has not: what it says itself always counts."""
        node, partial = self.prepare(node, partial)
        update: dict[str, object] = {}
        for name, value in field_values(partial).items():
            if name in _APART or _is_unwritten(value):
                continue
            mine = getattr(node, name)
            merged = self._merge_value(mine, value)
            if merged is not mine:
                update[name] = merged
        more = without_annotation(partial, REST, WRITTEN).opaque
        if more:
            update["opaque"] = (*more, *node.opaque)
        name = getattr(partial, "name", None)
        if name is not None and getattr(node, "name", name) != name:
            update["name"] = name
        return node.copy(**update) if update else node

    def _merge_value(self, mine: object, value: object) -> object:
        if are_nodes(value):
            return self.merge_all(cast("tuple[Node, ...]", mine), value)
        if not isinstance(value, Node):
            return value if _is_unwritten(mine) else mine
        if isinstance(mine, Node) and type(mine) is type(value):
            return self.merge(mine, value)
        return mine if mine is not None else self.added(value)

    def merge_all(self, mine: tuple[AnyNode, ...], partials: tuple[AnyNode, ...]) -> tuple[AnyNode, ...]:
        """The nodes with the partial ones of the same names merged into them, and the others behind them."""
        merged = dict(zip(_keys((each, getattr(each, "name", None)) for each in mine), mine, strict=True))
        keys = _keys(((each, written_name(each)) for each in partials), len(merged))
        for key, partial in zip(keys, partials, strict=True):
            if key in merged and find_annotation(partial, PLACE) is not None:  # what has its name is another one
                names = {*(name for _, name, _ in merged), *map(written_name, partials)}
                other = self.added(_renamed(partial, names))
                if other is not None:
                    merged[type(other), getattr(other, "name", None), 0] = other
            elif key in merged:
                merged[key] = self.merge(merged[key], partial)
            elif (added := self.added(partial)) is not None:
                merged[key] = added
        return _in_their_places([*merged.values()])

    def added(self, partial: AnyNode) -> AnyNode | None:
        """A node that the target does not say at all; None for the rest of one that it said once."""
        if is_rest(partial):  # what it belongs to is gone
            self.stale.append(partial)
            return None
        update: dict[str, object] = {}
        for name, value in field_values(partial).items():
            if isinstance(value, Node):
                added: object = self.added(value)
            elif are_nodes(value):
                added = tuple(each for one in value if (each := self.added(one)) is not None)
            else:
                continue
            if added is not value and added != value:
                update[name] = added
        return partial.copy(**update) if update else partial


def _renamed(node: AnyNode, taken: Collection[str | None]) -> AnyNode:
    """The node under a name that no other one has."""
    name = getattr(node, "name", None)
    free = (each for number in count(1) if (each := f"{name}_{number}") not in taken)
    return node.copy(name=next(free))


def _in_their_places(nodes: list[AnyNode]) -> tuple[AnyNode, ...]:
    """The nodes with those in their places that a note gives one."""
    found = [each for each in nodes if find_annotation(each, PLACE) is None]
    placed = [(each, find_annotation(each, PLACE)) for each in nodes]
    for each, note in placed:
        if note is not None:
            index = note.get("index") or ""
            at = min(int(index), len(found)) if index.isdecimal() else len(found)
            # Parts are written in the order of the file, so that it stands where its neighbor does.
            beside = found[at] if at < len(found) else found[-1] if found else each
            found.insert(at, without_annotation(each, PLACE).copy(source=beside.source))
    return tuple(found)


def is_rest(partial: Node) -> bool:
    """Whether a partial node is the rest of one of which the target says something."""
    return find_annotation(partial, REST) is not None


def is_bare(partial: Node) -> bool:
    """Whether a partial node, and all in it, hold nothing but names and annotations."""
    return not any(map(_holds, walk(partial)))


def _holds(node: Node) -> bool:
    """Whether a node has values of its own, or parts that are not ours alone: URDF's own are in a carrier."""
    values = ((name, value) for name, value in field_values(node).items() if name not in _APART)
    has_value = any(not (_is_unwritten(value) or isinstance(value, Node) or are_nodes(value)) for _, value in values)
    return has_value or any(not is_ours(part) or is_carrier(part, "urdf") for part in node.opaque)


def written_name(partial: Node) -> str | None:
    """The name that the target has for a node: its own, unless a note gives another one."""
    written = find_annotation(partial, WRITTEN)
    return getattr(partial, "name", None) if written is None else written.get("as")


def written_names(partial: Node) -> list[str]:
    """The names that the target has for a node of which it makes several; its own if no note gives any."""
    found = [part.element.get("as") or "" for part in partial.opaque if part.element and is_annotation(part, WRITTEN)]
    return found or [getattr(partial, "name", None) or ""]


def _keys(named: Iterable[tuple[Node, str | None]], start: int = 0) -> Iterator[tuple[type[Node], str | None, int]]:
    """Yield what tells nodes apart: their names, or their places; several of one name, as plugins, are counted."""
    counts = Counter[tuple[type[Node], str]]()
    for place, (node, name) in enumerate(named, start):
        if name is None:
            yield type(node), None, place
        else:
            yield type(node), name, counts[type(node), name]
            counts[type(node), name] += 1


def _is_unwritten(value: object) -> bool:
    return not value and (value is None or value == ())  # to compare records takes longer


@cache
def _parts_of(kind: type[Node], said: frozenset[str]) -> tuple[tuple[_Usual, ...], tuple[_Usual, ...]]:
    """The fields of a class that are left unsaid, and those that are said, with their defaults."""
    parts = [(name, each.default) for name, each in fields_of(kind).items() if name not in _APART]
    return tuple(each for each in parts if each[0] not in said), tuple(each for each in parts if each[0] in said)
