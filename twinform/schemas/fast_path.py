"""Fast path of the schema reader, for what is usual, which is nearly everything.

Everything here may give up: it then has done nothing, and the reader takes the long way, which reports. So nothing here
reports.
"""

from collections.abc import Callable, Mapping
from typing import Any

from twinform.schemas.facts import Fact, Version, rows_by_name
from twinform.schemas.messages import Context
from twinform.schemas.values import ValueType
from twinform.schemas.xml import XmlElement, is_blank

Parse = Callable[[Any], Any]

# Where libxml2 has accepted the document, nearly no element needs a finding, so asking first
# whether any does is cheaper than reading for findings.
GIVE_UP = (ValueError, KeyError, TypeError)
"""What a quick parser raises: bad text, an unknown name, no text at all."""

_VECTORS = frozenset({"vector3", "vector2d", "color", "color4"})
_BOOLS: dict[str, bool] = {"true": True, "false": False}


def quick_parse(row: Fact, types: Mapping[str, ValueType], version: Version) -> Parse | None:
    """A parser that gives up on every value that needs a diagnostic, or None where the row itself is unusual."""
    place = row.place
    if not place or "." in place or place[0] == "/" or row.type is None or row.fills_tuple:
        return None
    if not _is_usual(row, version):
        return None
    return _BOOLS.__getitem__ if row.type == "bool" else bounded_parse(row, types)


def _is_usual(row: Fact, version: Version) -> bool:
    """Whether the row itself calls for no diagnostic."""
    return row.exists_in(version) and not row.dialect and not row.deprecated


def bounded_parse(row: Fact, types: Mapping[str, ValueType]) -> Parse:
    """A parser that gives up on every value that needs a diagnostic."""
    parse: Parse = types[row.type or "string"].parse
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


class UsualElement:
    """Checks elements of which nothing goes into fields: whether one needs no diagnostic, nor any in it.

    Most elements of real files are of this sort: transmissions, sensors, physics, plugins.
    """

    def __init__(self, fact: Fact, types: Mapping[str, ValueType], version: Version, usual: "UsualOf") -> None:
        self._attributes = {
            name[1:]: bounded_parse(row, types) if _is_usual(row, version) else _give_up
            for name, row in rows_by_name(fact.attributes, version).items()
        }
        present = [row for row in fact.rows if row.exists_in(version)]
        self._needed_attributes = frozenset(
            row.name[1:] for row in present if row.is_attribute and (row.required or row.expected)
        )
        self._needed = frozenset(row.name for row in present if not row.is_attribute and row.required)
        self._rows = rows_by_name(fact.children, version)
        self._usual_rows = {name: row for name, row in self._rows.items() if _is_usual(row, version)}
        self._repeating = frozenset(name for name, row in self._rows.items() if row.repeats)
        self._kinds = frozenset(row.name for row in fact.children if row.kind)
        self._made: dict[str, UsualElement] = {}
        self._usual, self._free, self._type = usual, fact.any, fact.type
        self._parse = bounded_parse(fact, types) if fact.type else None
        self._has_meaning = fact.needs_text or bool(fact.default)
        self._needs_text = fact.needs_text

    def holds(self, element: XmlElement, context: Context) -> bool:
        """Whether the element is as usual."""
        names = element.items()
        if names and not self._takes_attributes(names):
            return False
        if self._needed_attributes and not self._needed_attributes.issubset(element.keys()):
            return False
        if self._parse is not None:
            if not self._takes_text(element, self._parse, context):
                return False
        elif not self._free and not is_blank(element.text or ""):
            return False
        return self._takes_children(element, context) if len(element) else not self._needed

    def _takes_attributes(self, items: list[tuple[str, str]]) -> bool:
        for name, text in items:
            parse = self._attributes.get(name)
            if parse is None:
                if not self._free or name[0] == "{":
                    return False
                continue
            try:
                parse(text)
            except GIVE_UP:
                return False
        return True

    def _takes_text(self, element: XmlElement, parse: Parse, context: Context) -> bool:
        text = element.text or ""
        if self._type == "string":
            text = text.strip(" \t\r\n")
            if not text and self._has_meaning and context.format == "sdf":
                return False
        elif is_blank(text):
            return self._type == "pose" and not self._needs_text
        try:
            value = parse(text)
        except GIVE_UP:
            return False
        # Seven numbers and a quaternion belong together; either alone is a finding.
        return self._type != "pose" or (len(value) == 6 and element.get("rotation_format") != "quat_xyzw")

    def _takes_children(self, element: XmlElement, context: Context) -> bool:
        found: set[str] = set()
        for child in element:
            tag: str = child.tag  # pyright: ignore[reportAssignmentType] - the parser removes comments
            if tag not in self._usual_rows:
                if not self._free or tag in self._rows:
                    return False
                continue
            if tag in found and tag not in self._repeating:
                return False
            found.add(tag)
            usual = self._made.get(tag) or self._usual_child(tag)
            if not usual.holds(child, context) or not (context.clean or self._free or is_blank(child.tail or "")):
                return False
        return self._needed <= found and (not self._kinds or len(self._kinds & found) <= 1)

    def _usual_child(self, tag: str) -> "UsualElement":
        self._made[tag] = usual = self._usual(self._usual_rows[tag])
        return usual


def _give_up(text: str) -> None:
    raise ValueError(text)


UsualOf = Callable[[Fact], UsualElement]
"""The usual form of a row's element: that of the definition that the row refers to, or its own."""
