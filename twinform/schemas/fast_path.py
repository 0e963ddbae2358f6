"""Fast path of the schema reader, for an element in which nothing is unusual, which is nearly every one.

It is for documents that the schema has accepted and that have no namespaces: there, an element that the facts give no
children has none. Everything here may give up: it then says so, has done nothing, and the reader takes the long way,
which knows what to report. So nothing here checks twice, and none of it reports.
"""

from collections.abc import Callable
from typing import Any

from twinform.schemas.facts import Fact, Version
from twinform.schemas.value_stores import Data
from twinform.schemas.values import ValueType
from twinform.schemas.xml import XmlElement

Parse = Callable[[Any], Any]
Quick = Callable[[XmlElement, Data], bool]
"""Reads an element into the dict of its node and returns whether it did: (element, node)"""

GIVE_UP = (ValueError, KeyError, TypeError)
"""What a quick parser raises: bad text, an unknown name, no text at all."""

_VECTORS = frozenset({"vector3", "vector2d", "color", "color4"})
_BOOLS: dict[str, bool] = {"true": True, "false": False}


def quick_parse(row: Fact, types: dict[str, ValueType], version: Version) -> Parse | None:
    """A parser that gives up on every value that needs a diagnostic, or None where the row itself is unusual."""
    place = row.place
    if (
        not place
        or "." in place
        or place[0] == "/"
        or row.type is None
        or row.fills_tuple
        or not row.exists_in(version)
        or row.dialect
    ):
        return None
    if row.type == "bool":
        return _BOOLS.__getitem__
    parse: Parse = types[row.type].parse
    if row.enum:
        return {word: word for word in row.enum}.__getitem__
    if row.min is None and row.max is None:
        return parse
    low = row.min if row.min is not None else float("-inf")
    high = row.max if row.max is not None else float("inf")

    def parse_bounded(text: str) -> float:
        value: float = parse(text)
        if low <= value <= high:
            return value
        raise ValueError

    def parse_vector(text: str) -> tuple[float, ...]:
        values: tuple[float, ...] = parse(text)
        if low <= min(values) and max(values) <= high:
            return values
        raise ValueError

    return parse_vector if row.type in _VECTORS else parse_bounded


def quick_attributes(fact: Fact, types: dict[str, ValueType], version: Version) -> Quick | None:
    """Reads an element that has attributes and nothing else; None for one that has more."""
    if fact.any or fact.type is not None or fact.children or not fact.attributes:
        return None
    parses: dict[str, tuple[str, Parse]] = {}
    for row in fact.attributes:
        parse = quick_parse(row, types, version)
        if parse is not None:
            parses[row.name[1:]] = (row.place or "", parse)
    rows = [row for row in fact.attributes if row.exists_in(version)]
    needed = frozenset(row.place or row.name for row in rows if row.required or row.expected)

    def read(element: XmlElement, node: Data) -> bool:
        found: Data = {}
        try:
            for name, text in element.items():
                place, parse = parses[name]
                found[place] = parse(text)
        except GIVE_UP:
            return False
        if not found or not needed <= found.keys():
            return False
        node.update(found)
        return True

    return read


def quick_pose(fact: Fact, types: dict[str, ValueType]) -> Quick | None:
    """Reads a pose of six numbers and no attributes; None for what is no pose."""
    if fact.type != "pose":
        return None
    parse: Parse = types["pose"].parse

    def read(element: XmlElement, node: Data) -> bool:
        if element.keys():
            return False
        try:
            values = parse(element.text)
        except (*GIVE_UP, AttributeError):
            return False
        if len(values) != 6:
            return False
        node["xyz"], node["rpy"] = values[:3], values[3:]
        return True

    return read
