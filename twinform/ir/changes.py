"""Changes between two states of one document, by node and field: what a pass did.

Nodes are matched by their names; those that are left by what they say, which finds what was only renamed; and those
without a name at last by their order. Parts that are one object
in both documents are not looked into, so that what a pass left alone costs nothing.
"""

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterator, Sequence
from enum import StrEnum
from typing import NamedTuple, TypeVar, cast

from twinform.ir.node import Node
from twinform.ir.record import Sourced, field_values

_NAMES = ("name", "reference", "uri")
"""Fields that tell nodes of one kind apart, the best first."""
Part = TypeVar("Part", bound=Sourced)


class ChangeKind(StrEnum):
    """What happened to a node or value; its value is the sign printed for it."""

    ADDED = "+"
    REMOVED = "-"
    CHANGED = "~"
    REORDERED = ">"


class NodeChange(NamedTuple):
    """A change of one value or node: `node` is the path of the node, `path` that of the value or node itself.

    Paths are those of the JSON of a document, with names in brackets where lists have names.
    """

    how: ChangeKind
    node: str
    path: str
    old: object = None
    new: object = None

    @property
    def is_node(self) -> bool:
        """Whether a whole node was added or removed."""
        return self.node == self.path


def changes(old: Node, new: Node) -> Iterator[NodeChange]:
    """List every difference of two documents, from the outside in."""
    return _inside(old, new, "")


def _inside(old: Node, new: Node, path: str) -> Iterator[NodeChange]:
    if old is new:
        return
    for name, before in field_values(old).items():
        after = getattr(new, name)
        if before is not after:
            yield from _field(before, after, path, f"{path}/{name}")


def _field(old: object, new: object, node: str, path: str) -> Iterator[NodeChange]:
    if isinstance(old, Node) and type(old) is type(new):
        yield from _inside(old, cast("Node", new), path)
    elif isinstance(old, Node) or isinstance(new, Node):
        yield from _list_whole_node(ChangeKind.REMOVED, old, path)
        yield from _list_whole_node(ChangeKind.ADDED, new, path)
    elif _has_parts(old) or _has_parts(new):
        yield from _lists(cast("Sequence[Sourced]", old or ()), cast("Sequence[Sourced]", new or ()), node, path)
    elif not _is_same(old, new):
        yield NodeChange(ChangeKind.CHANGED, node, path, old, new)


def _is_same(old: object, new: object) -> bool:
    """Tell whether two values are equal, with NaN equal to itself."""
    return old == new or (isinstance(old, float | tuple) and repr(cast("object", old)) == repr(new))


def _has_parts(value: object) -> bool:
    parts = cast("tuple[object, ...]", value) if isinstance(value, tuple) else ()
    return bool(parts) and isinstance(parts[0], Sourced)


def _list_whole_node(how: ChangeKind, part: object, path: str) -> Iterator[NodeChange]:
    """Yield a node that only one document has, with all values in it."""
    if not isinstance(part, Node):
        return
    yield NodeChange(how, path, path)
    for name, value in field_values(part).items():
        if value is None or value == ():
            continue
        inner = f"{path}/{name}"
        if isinstance(value, Node):
            yield from _list_whole_node(how, value, inner)
        elif _has_parts(value):
            for each, label in zip(value, _labels(value), strict=True):
                yield from _alone(how, each, path, inner + label)
        else:
            yield _value(how, value, path, inner)


def _value(how: ChangeKind, value: object, node: str, path: str) -> NodeChange:
    return NodeChange(how, node, path, *((value, None) if how is ChangeKind.REMOVED else (None, value)))


def _alone(how: ChangeKind, part: Sourced, node: str, path: str) -> Iterator[NodeChange]:
    """Yield the change of a list element that only one document has."""
    if isinstance(part, Node):
        yield from _list_whole_node(how, part, path)
    else:
        yield _value(how, part, node, path)


def _lists(old: Sequence[Sourced], new: Sequence[Sourced], node: str, path: str) -> Iterator[NodeChange]:
    pairs = _matched(old, new)
    old_labels, new_labels = _labels(old), _labels(new)
    for at, part in enumerate(old):
        if at not in pairs:
            yield from _alone(ChangeKind.REMOVED, part, node, path + old_labels[at])
    if [pairs[at] for at in sorted(pairs)] != sorted(pairs.values()):
        yield NodeChange(ChangeKind.REORDERED, node, path, old_labels, new_labels)
    back = {after: before for before, after in pairs.items()}
    for at, part in enumerate(new):
        if at not in back:
            yield from _alone(ChangeKind.ADDED, part, node, path + new_labels[at])
            continue
        before = old[back[at]]
        if isinstance(before, Node) and isinstance(part, Node):  # others are pairs only where they are equal
            yield from _inside(before, part, path + new_labels[at])


def _matched(old: Sequence[Sourced], new: Sequence[Sourced]) -> dict[int, int]:
    """Return which place in the old list corresponds to which in the new one."""
    pairs = dict[int, int]()
    for key in (_name, _without_name, _kind):
        taken = set(pairs.values())
        pairs |= _pair(_group_by(key, old, set(pairs)), _group_by(key, new, taken))
    return pairs


def _pair(old: dict[Hashable, list[int]], new: dict[Hashable, list[int]]) -> dict[int, int]:
    """Pair the places with equal keys, in order."""
    return {a: b for key, places in old.items() for a, b in zip(places, new.get(key, ()), strict=False)}


def _group_by(
    key: Callable[[Sourced], Hashable | None], parts: Sequence[Sourced], but: set[int]
) -> dict[Hashable, list[int]]:
    """Group the places of parts by their keys."""
    found: dict[Hashable, list[int]] = defaultdict(list)
    for at, part in enumerate(parts):
        word = None if at in but else key(part)
        if word is not None:
            found[word].append(at)
    return found


def _name(part: Sourced) -> Hashable | None:
    name = name_of(part)
    return None if name is None else (type(part), name)


def _without_name(part: Sourced) -> Hashable:
    """Return a part without its name, as a key that is equal for parts which were only renamed."""
    return part.copy(name=None) if isinstance(part, Node) and hasattr(part, "name") else part


def _kind(part: Sourced) -> Hashable | None:
    return type(part) if isinstance(part, Node) and name_of(part) is None else None


def name_of(part: Sourced) -> str | None:
    """Return what tells a node apart from its siblings; None if it has no name."""
    if not isinstance(part, Node):
        return None
    return next((name for key in _NAMES if isinstance(name := getattr(part, key, None), str)), None)


def _labels(parts: Sequence[Sourced]) -> list[str]:
    return [f"[{at}]" if (name := name_of(part)) is None else f"[{name!r}]" for at, part in enumerate(parts)]


class Sizes(NamedTuple):
    """How many nodes changed, were added and were removed."""

    changed: int
    added: int
    removed: int


def count_changes(old: Node, new: Node) -> Sizes:
    """Count the nodes with other values or order, the new ones, and the removed ones."""
    changed, added, removed = set[str](), 0, 0
    whole = set[str]()
    for each in changes(old, new):
        if each.is_node:
            added, removed = added + (each.how is ChangeKind.ADDED), removed + (each.how is ChangeKind.REMOVED)
            whole.add(each.path)
        elif each.node not in whole:
            changed.add(each.node)
    return Sizes(len(changed), added, removed)
