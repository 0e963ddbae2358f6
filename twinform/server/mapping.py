"""Rows of the facts tables: all that a file may use, the fields of the IR that they fill, and their counterparts."""

import json
from collections.abc import Iterator
from dataclasses import field
from functools import cache
from typing import Literal, NamedTuple, Self, cast, get_args

from twinform.dataclass import dataclass
from twinform.ir import Document, Model, Node
from twinform.ir.record import fields_of
from twinform.ir.versions import Version
from twinform.package_files import package_files
from twinform.schemas import table
from twinform.schemas.facts import Fact

FormatName = Literal["urdf", "sdf", "mjcf"]
FORMATS: tuple[FormatName, ...] = ("urdf", "sdf")
"""The formats whose rows have counterparts in each other."""


@dataclass(frozen=True, slots=True)
class MappingRow:
    """A row of a table: its definition, the steps from there, and the first version that has it.

    A name may have several rows, one for each range of versions.
    """

    format: FormatName
    definition: str
    steps: str
    since: Version
    fact: Fact = field(compare=False, repr=False)

    @property
    def path(self) -> str:
        """Definition and steps, such as `link/inertial/mass`."""
        return f"{self.definition}/{self.steps}"


@cache
def rows(format: FormatName) -> tuple[MappingRow, ...]:
    """Return all rows that a file may use, in the order of the table."""
    reachable = frozenset(sections(format))
    definitions = table(format).definitions.items()
    return tuple(row for name, fact in definitions if name in reachable for row in _rows_below(format, name, fact, ""))


@cache
def sections(format: FormatName) -> tuple[str, ...]:
    """Return the definitions that a file may use, from the root on."""
    facts = table(format)
    found = [facts.root]
    for name in found:  # it grows in the loop
        for row in _rows_below(format, name, facts.definitions[name], ""):
            if row.fact.reference and row.fact.reference not in found:
                found.append(row.fact.reference)
    return tuple(found)


def _rows_below(format: FormatName, definition: str, fact: Fact, around: str) -> Iterator[MappingRow]:
    for below in fact.rows:
        steps = f"{around}{below.name}"
        yield MappingRow(format, definition, steps, below.since, below)
        if not below.reference:
            yield from _rows_below(format, definition, below, f"{steps}/")


Chain = tuple[str, ...]
"""Fields of the IR from the outermost, each with its class, such as `("Joint.axis", "Axis.xyz")`."""
_ROOTS: dict[FormatName, type[Node]] = {"urdf": Model, "sdf": Document, "mjcf": Document}


def field_of(row: MappingRow) -> str:
    """Return the field that a row fills, such as `Inertial.mass`; empty if it is kept without a typed form."""
    chain = chains_of(row.format).get(row)
    return chain[-1] if chain else ""


@cache
def chains_of(format: FormatName) -> dict[MappingRow, Chain]:
    """Return the chain of every row that has a place in the IR; the first, if a definition is used several times."""
    facts = table(format)
    found: dict[MappingRow, Chain] = {}
    ahead, seen = [(facts.root, _ROOTS[format])], {facts.root}
    while ahead:
        definition, kind = ahead.pop(0)
        for row, chain, inner in _follow_rows(format, definition, facts.definitions[definition], kind, (), ""):
            found.setdefault(row, chain)
            if row.fact.reference and inner is not None and row.fact.reference not in seen:
                seen.add(row.fact.reference)
                ahead.append((row.fact.reference, inner))
    return found


def _follow_rows(
    format: FormatName, definition: str, fact: Fact, kind: type[Node], around: Chain, steps: str
) -> Iterator[tuple[MappingRow, Chain, type[Node] | None]]:
    """Yield each row below that has a place, with its chain and the class of the node that it makes."""
    for below in fact.rows:
        if below.place is None:
            continue
        row = MappingRow(format, definition, f"{steps}{below.name}", below.since, below)
        chain, inner = _follow(below, kind, around)
        if below.place != ".":
            yield row, chain, inner
        if not below.reference:  # an attribute of a value, such as the unit of a text, fills a field of the node around
            inside = (inner, chain) if inner is not None else (kind, around)
            yield from _follow_rows(format, definition, below, *inside, f"{row.steps}/")


def _follow(row: Fact, kind: type[Node], around: Chain) -> tuple[Chain, type[Node] | None]:
    """Return the chain of a row, and the class of the node that it makes or fills; None for a value."""
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
    """Return the class of nodes in an annotation; the one of that `kind`, if there are several."""
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


class Destination(NamedTuple):
    """What expresses a row in the other format, and its fates in the case files, the most frequent first."""

    goes: str
    fates: str


def destination(row: MappingRow) -> Destination:
    """Look up what expresses a row in the other format, in the table that `make generate` writes."""
    goes, fates = _destinations().get(row.format, {}).get(row.path, ("", ""))
    return Destination(goes, fates)


@cache
def _destinations() -> dict[FormatName, dict[str, tuple[str, str]]]:
    text = package_files("twinform.server").joinpath("destinations.json").read_text(encoding="utf-8")
    return json.loads(text)
