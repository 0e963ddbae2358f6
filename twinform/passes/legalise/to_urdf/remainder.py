"""Remainder of a node: the fields that URDF cannot express, found by the URDF facts table."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import field
from functools import cache
from types import MappingProxyType
from typing import NamedTuple, TypeVar, Union

from twinform.dataclass import dataclass
from twinform.ir import Element, Node, Opaque
from twinform.ir.node import NOT_CONTENT
from twinform.ir.record import field_values, fields_of
from twinform.ir.rewrite import classes_in
from twinform.ir.versions import parse_version
from twinform.passes.carriers.carriers import is_ours, to_element
from twinform.request_options import UrdfVersion
from twinform.schemas import Fact, Version, format_value, table

AnyNode = TypeVar("AnyNode", bound=Node)


class KnownFields(dict[str, Union["KnownFields", None]]):
    """The fields of a node that URDF has, each with its inner fields, or None for a plain value."""

    def __init__(self, fields: Mapping[str, "KnownFields | None"] = MappingProxyType({})) -> None:
        super().__init__(fields)
        self.questions: dict[type[Node], _Questions] = {}
        """The questions of `fits` for each class of nodes, cached."""


class _Questions(NamedTuple):
    """The fields of a class that URDF lacks, those that may hold numbers, and those that hold nodes it has."""

    unknown: tuple[str, ...]
    numbers: tuple[str, ...]
    nodes: tuple[tuple[str, KnownFields], ...]


_IDENTITY = frozenset({"name", "type", "kind"})
_APART = _IDENTITY | NOT_CONTENT | {"opaque"}
_NONE: tuple[()] = ()
"""There is only one empty tuple."""


@dataclass(slots=True)
class SplitNode:
    """The two halves of a node: what URDF can write is `kept`, the rest is `left`.

    `paths` are the places below the node that are in both halves; `endless` are the paths and texts of kept numbers
    that are not finite, which URDF cannot write.
    """

    kept: dict[str, object] = field(default_factory=dict[str, object])
    left: dict[str, object] = field(default_factory=dict[str, object])
    paths: list[str] = field(default_factory=list[str])
    endless: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])


@cache
def urdf_fields(version: UrdfVersion, definition: str, *steps: str) -> KnownFields:
    """The fields that a version of URDF has for a definition, or for the row below it at the path `steps`."""
    known = KnownFields()
    _collect(urdf_row(version, definition, *steps), known, parse_version(version))
    return known


def urdf_row(version: UrdfVersion, definition: str, *steps: str) -> Fact:
    """The facts of a definition in a version, or of the row below it at the path `steps`."""
    facts, number = table("urdf"), parse_version(version)
    fact = facts.definitions[definition]
    for step in steps:
        fact = facts.resolve(next(row for row in fact.rows if row.name == step and row.exists_in(number)))
    return fact


def _collect(fact: Fact, known: KnownFields, version: Version) -> None:
    if fact.any and fact.place:
        known[fact.place] = None
    for row in fact.rows:
        if not row.exists_in(version):
            continue
        if row.place == ".":
            _collect(table("urdf").resolve(row), known, version)
        elif row.place:
            _place(row, known, version)


def _place(row: Fact, known: KnownFields, version: Version) -> None:
    *outer, last = row.place.split(".") if row.place else [""]
    for step in outer:
        inner = known.setdefault(step, KnownFields())
        known = inner if inner is not None else KnownFields()
    if row.is_attribute or row.type:
        known[last] = None
        return
    inside = KnownFields()
    _collect(table("urdf").resolve(row), inside, version)
    if row.kind is None:
        known[last] = KnownFields({**(known.get(last) or {}), **inside})
    else:
        kinds = known.setdefault(last, KnownFields())
        if kinds is not None:
            kinds[row.kind] = inside


def take_remainder(node: AnyNode, tag: str, known: KnownFields) -> tuple[AnyNode, list[Opaque], list[tuple[str, str]]]:
    """The node with what URDF can write, the rest as pieces of its SDF element, and numbers that are not finite.

    Nodes in tuples (links, visuals, ...) stay: they have remainders of their own.
    """
    # Nearly every node fits. Asking that first costs a few attribute reads; taking a node apart
    # costs many times as much.
    if fits(node, known):
        return node, [], []
    split = _split(node, known, "", own_element=True)
    if not split.left:
        return node, [], split.endless
    kept = node.copy(**split.kept)
    left = _only(node, split.left)
    pieces = _pieces(to_element(left, tag, "sdf"), "", frozenset(split.paths), _IDENTITY & fields_of(type(node)).keys())
    return kept, list(pieces), split.endless


def fits(node: Node, known: KnownFields) -> bool:
    """Whether URDF can write everything in a node."""
    return all(is_ours(part) or _is_foreign(part) for part in node.opaque) and _fits(node, known)


def _fits(node: Node, known: KnownFields) -> bool:
    kind = type(node)
    unknown, numbers, nodes = known.questions.get(kind) or _questions(kind, known)
    for name in unknown:
        value = getattr(node, name)
        if value is not None and value is not _NONE:
            return False
    for name in numbers:
        if _is_endless(getattr(node, name)):
            return False
    for name, fields in nodes:
        value = getattr(node, name)
        if isinstance(value, Node):
            shape = getattr(value, "kind", None)
            found = fields if shape is None else fields.get(shape)
            if found is None or value.opaque or not _fits(value, found):
                return False
    return True


def _questions(kind: type[Node], known: KnownFields) -> _Questions:
    names = [name for name in fields_of(kind) if name not in _APART]
    numbers = (name for name in names if name in known and "float" in str(fields_of(kind)[name].type))
    nodes = ((name, inner) for name in names if (inner := known.get(name)) is not None and classes_in(kind, name))
    made = _Questions(tuple(name for name in names if name not in known), tuple(numbers), tuple(nodes))
    known.questions[kind] = made
    return made


def _split(node: Node, known: KnownFields, path: str, *, own_element: bool) -> SplitNode:
    split = SplitNode()
    for name, value in field_values(node).items():
        if value is None or value is _NONE or name in _APART:
            continue
        if name not in known:
            # The table of URDF decides, not a list in here: a field that a new version of URDF
            # brings stays in the URDF from then on.
            split.left[name], split.kept[name] = value, _blank(node, name)
            continue
        inner = known[name]
        if inner is None:
            if _is_endless(value):
                split.endless.append((f"{path}/{name}" if path else name, format_value(value)))
        elif isinstance(value, Node):
            _split_inner(split, name, value, inner, path)
    _split_opaque(split, node, own_element=own_element)
    return split


def _split_inner(split: SplitNode, name: str, value: Node, known: KnownFields, path: str) -> None:
    kind = getattr(value, "kind", None)
    if kind is not None:
        found = known.get(str(kind))
        if found is None:
            split.left[name], split.kept[name] = value, None
            return
        known = found
    below = f"{path}/{kind or name}" if path else str(kind or name)
    inner = _split(value, known, below, own_element=False)
    split.endless += inner.endless
    if not inner.left:
        return
    kept = value.copy(**inner.kept)
    if kind is None and _is_empty(kept):  # then it is carried whole, beside nothing
        split.left[name], split.kept[name] = value, None
        return
    split.left[name] = _only(value, inner.left)
    split.kept[name] = kept
    split.paths += [below, *inner.paths]


def _is_empty(node: Node) -> bool:
    """Whether a node has no field set besides its kind."""
    return all(value in (None, ()) for name, value in field_values(node).items() if name != "kind")


def _is_endless(value: object) -> bool:
    if value is None:
        return False
    # Not isinstance: bool and int are no floats, and this is asked for every field of every node.
    if type(value) is float:
        return not math.isfinite(value)
    return isinstance(value, tuple) and any(map(_is_endless, value))  # pyright: ignore[reportUnknownArgumentType] - any


def _split_opaque(split: SplitNode, node: Node, *, own_element: bool) -> None:
    """Split the opaque parts: carriers stay, and other tools' parts where the node is an element of URDF too."""
    if not node.opaque:
        return
    stays = [part for part in node.opaque if is_ours(part) or (own_element and _is_foreign(part))]
    staying = set(map(id, stays))  # to compare each with each would take the square of their number
    leaves = tuple(part for part in node.opaque if id(part) not in staying)
    if leaves:
        split.left["opaque"], split.kept["opaque"] = leaves, tuple(stays)


def _is_foreign(part: Opaque) -> bool:
    return not part.at and _qualified(part).startswith("{")


def _qualified(part: Opaque) -> str:
    if part.element is not None:
        return part.element.name
    return part.attribute[0] if part.attribute else ""


def _only(node: Node, fields: dict[str, object]) -> Node:
    """The node with no fields set but these."""
    blank = {name: _blank(node, name) for name in fields_of(type(node)) if name not in _APART}
    return node.copy(**{**blank, "opaque": (), **fields})


def _blank(node: Node, name: str) -> object:
    """The value of a field that was not written."""
    return _blanks(type(node))[name]


@cache
def _blanks(kind: type[Node]) -> dict[str, object]:
    return {name: field.default for name, field in fields_of(kind).items()}


def _pieces(
    element: Element, at: str, paths: frozenset[str], identity: frozenset[str] = frozenset()
) -> Iterator[Opaque]:
    """The content of an element as pieces, without the attributes of its identity, which both halves have."""
    for name, value in element.attributes:
        if name not in identity:
            yield Opaque.unchecked(at=at, attribute=(name, value))
    if element.text:
        yield Opaque.unchecked(at=at, text=element.text)
    for child in element.children:
        below = f"{at}/{child.name}" if at else child.name
        if below in paths:
            yield from _pieces(child, below, paths)
        else:
            yield Opaque.unchecked(at=at, element=child)
