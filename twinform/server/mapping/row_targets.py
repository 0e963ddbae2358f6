"""Where the IR keeps what a row defines, and which rows of the other format fill the same field."""

from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from typing import Self, cast, get_args

from twinform.ir import Document, Model, Node
from twinform.ir.record import fields_of
from twinform.schemas import table
from twinform.schemas.facts import Fact
from twinform.server.mapping.rows import FORMATS, FormatName, MappingRow, rows

Chain = tuple[str, ...]
"""Fields of the IR from the outside in, each with its class: `("Joint.axis", "Axis.xyz")`."""
_ROOTS: dict[FormatName, type[Node]] = {"urdf": Model, "sdf": Document}
_POSE = frozenset({"Pose.xyz", "Pose.rpy", "Pose.quat_xyzw"})


def field_of(row: MappingRow) -> str:
    """The field that a row fills, such as `Inertial.mass`; empty for what is kept as it stands."""
    chain = _chains(row.format).get(row)
    return chain[-1] if chain else ""


def targets(row: MappingRow) -> list[str]:
    """The paths of the rows of the other format that fill the same field, each once."""
    chain = _chains(row.format).get(row)
    if not chain:
        return []
    other = next(name for name in FORMATS if name != row.format)
    if chain[-1] in _POSE and other == "sdf":
        return ["pose"]
    found = (one.path for one, its in _by_field(other)[chain[-1]] if _fits(chain, its))
    return list(dict.fromkeys(found))


def _fits(one: Chain, other: Chain) -> bool:
    """Whether they name the same field, as far as both state what it is in."""
    return all(a == b for a, b in zip(reversed(one), reversed(other), strict=False))


@cache
def _by_field(format: FormatName) -> dict[str, list[tuple[MappingRow, Chain]]]:
    found: dict[str, list[tuple[MappingRow, Chain]]] = defaultdict(list)
    for row in rows(format):
        if chain := _chains(format).get(row):
            found[chain[-1]].append((row, chain))
    return found


@cache
def _chains(format: FormatName) -> dict[MappingRow, Chain]:
    """The chain of every row that has a place in the IR; where a definition has several, the first."""
    facts = table(format)
    found: dict[MappingRow, Chain] = {}
    ahead, seen = [(facts.root, _ROOTS[format])], {facts.root}
    while ahead:
        definition, kind = ahead.pop(0)
        for row, chain, inner in _placed(format, definition, facts.definitions[definition], kind, (), ""):
            found.setdefault(row, chain)
            if row.fact.reference and inner is not None and row.fact.reference not in seen:
                seen.add(row.fact.reference)
                ahead.append((row.fact.reference, inner))
    return found


def _placed(
    format: FormatName, definition: str, fact: Fact, kind: type[Node], around: Chain, steps: str
) -> Iterator[tuple[MappingRow, Chain, type[Node] | None]]:
    """Each row below that has a place: its chain, and the class of the node that it makes."""
    for below in fact.rows:
        if below.place is None:
            continue
        row = MappingRow(format, definition, f"{steps}{below.name}", below.since, below)
        chain, inner = _follow(below, kind, around)
        if below.place != ".":
            yield row, chain, inner
        if not below.reference:  # what is in a value, such as an attribute beside a text, is in the node around it
            inside = (inner, chain) if inner is not None else (kind, around)
            yield from _placed(format, definition, below, *inside, f"{row.steps}/")


def _follow(row: Fact, kind: type[Node], around: Chain) -> tuple[Chain, type[Node] | None]:
    """The chain of a row, and the class of the node that it makes or fills; None for a value."""
    if row.place == ".":
        return around, kind
    if row.place is not None and row.place.startswith("/"):
        return (f"Document.{row.place[1:]}",), None
    inner: type[Node] | None = kind
    for name in (row.place or "").split("."):
        if inner is None:
            break
        around = (*around, f"{inner.__name__}.{name}" + (f":{row.kind}" if row.kind else ""))
        inner = _class_of(fields_of(inner)[name].type, kind, row.kind)
    return around, inner


def _class_of(annotation: object, around: type[Node], kind: str | None) -> type[Node] | None:
    """The class of nodes in an annotation; of several, the one of that kind."""
    for one in _classes(annotation, around):
        if kind is None or get_args(fields_of(one)["kind"].type) == (kind,):
            return one
    return None


def _classes(annotation: object, around: type[Node]) -> Iterator[type[Node]]:
    if isinstance(annotation, type) and issubclass(annotation, Node):
        yield annotation
    elif annotation is Self:
        yield around
    else:
        for inner in cast("tuple[object, ...]", get_args(annotation)):
            yield from _classes(inner, around)
