"""From the IR to XML: closures built once for each format and version from the same facts as the reader's.

A writer writes what the node says, in the order of the facts, and decides nothing. It knows nodes only by the names of
their fields. Children that came from a file keep the order that they had in it.
"""

from collections.abc import Callable, Iterable
from functools import cache
from operator import attrgetter
from typing import Any

from lxml import etree

from twinform.schemas.facts import Fact, Table, Version, table
from twinform.schemas.values import format_number, format_value, parse_bool
from twinform.schemas.xml import XmlElement

Write = Callable[[Any, XmlElement], None]
"""Writes a node's fields into an element: (node, element)"""
Get = Callable[[Any], Any]


def element_xml(element: Any, parent: XmlElement | None = None) -> XmlElement:
    """The XML of an IR `Element`, below `parent` where one is given."""
    attributes = dict(element.attributes)
    if parent is None:
        made = etree.Element(element.name, attributes)
    else:
        made = etree.SubElement(parent, element.name, attributes)
    made.text, made.tail = element.text, element.tail
    for child in element.children:
        element_xml(child, made)
    return made


class Writer:
    """Writes nodes in one format and version."""

    def __init__(self, facts: Table, version: Version) -> None:
        self.table = facts
        self.version = version
        self.writes: dict[str, Write] = {}
        for name, definition in facts.definitions.items():
            self.writes[name] = self._node(definition)

    def write(self, node: Any, element: XmlElement, definition: str | None = None) -> None:
        """Write a node into an element that is there already."""
        self.writes[definition or self.table.root](node, element)

    def _node(self, fact: Fact) -> Write:
        """The writer of an element that is a node of its own."""
        fields = self._fields(fact)
        content = fact.place if fact.any else None

        def write(node: Any, element: XmlElement) -> None:
            fields(node, element)
            if content is not None:
                for child in getattr(node, content):
                    element_xml(child, element)
            if node.opaque:
                _write_opaque(node.opaque, element)

        return write

    def _fields(self, fact: Fact) -> Write:
        attributes = [self._attribute(row) for row in self._rows(fact.attributes)]
        text = _text(fact)
        single = [self._child(row) for row in self._rows(fact.children) if not _makes_many(row)]
        many = [self._many(row) for row in self._rows(fact.children) if _makes_many(row)]

        def write(node: Any, element: XmlElement) -> None:
            for write_attribute in attributes:
                write_attribute(node, element)
            if text is not None:
                element.text = text(node)
            for write_child in single:
                write_child(node, element)
            if many:
                _write_in_order([(child, one) for get, one in many for child in get(node)], element)

        return write

    def _rows(self, rows: list[Fact]) -> list[Fact]:
        """One row with a place for each name; this version's where it has one."""
        best: dict[str, Fact] = {}
        for row in rows:
            if (
                row.place
                and row.place[0] != "/"
                and (row.name not in best or not best[row.name].exists_in(self.version))
            ):
                best[row.name] = row
        return list(best.values())

    def _attribute(self, row: Fact) -> Write:
        name, get, show = row.name[1:], _getter(row.place or ""), _format(row)

        def write(node: Any, element: XmlElement) -> None:
            value = get(node)
            if value is not None:
                element.set(name, show(node, value))

        return write

    def _child(self, row: Fact) -> Write:
        if row.type is not None:
            return self._leaf(row)
        if row.place == ".":
            return self._hoisted(row)
        return self._own_node(row)

    def _inner(self, row: Fact) -> Write:
        if row.reference is None:
            return self._node(row)
        writes, name = self.writes, row.reference
        return lambda node, element: writes[name](node, element)

    def _leaf(self, row: Fact) -> Write:
        name, get, show, repeats = row.name, _getter(row.place or ""), _format(row), row.repeats
        attributes = [(_getter(a.place or ""), self._attribute(a)) for a in self._rows(row.attributes)]

        def write(node: Any, element: XmlElement) -> None:
            value = get(node)
            if repeats:
                for item in value:
                    etree.SubElement(element, name).text = show(node, item)
                return
            if value is None and all(get_attribute(node) is None for get_attribute, _ in attributes):
                return
            leaf = etree.SubElement(element, name)
            if value is not None:
                leaf.text = show(node, value)
            for _, write_attribute in attributes:
                write_attribute(node, leaf)

        return write

    def _hoisted(self, row: Fact) -> Write:
        name, fields = row.name, self._fields(row)
        gets = [_getter(place) for place in _places(row)]

        def write(node: Any, element: XmlElement) -> None:
            if any(get(node) is not None for get in gets):
                fields(node, etree.SubElement(element, name))

        return write

    def _own_node(self, row: Fact) -> Write:
        """The writer of a child node that may be there once. One that says nothing in this format is not written."""
        name, get, kind, inner = row.name, _getter(row.place or ""), row.kind, self._inner(row)

        def write(node: Any, element: XmlElement) -> None:
            child = get(node)
            if child is None or (kind is not None and child.kind != kind):
                return
            made = etree.SubElement(element, name)
            inner(child, made)
            if kind is None and not len(made) and not made.attrib and not made.text:
                element.remove(made)

        return write

    def _many(self, row: Fact) -> tuple[Get, Write]:
        name, inner = row.name, self._inner(row)

        def write(child: Any, element: XmlElement) -> None:
            inner(child, etree.SubElement(element, name))

        return _getter(row.place or ""), write


@cache
def writer(format: str, version: Version) -> Writer:  # noqa: A002 - the word of the domain
    """The writer of a format in a version."""
    return Writer(table(format), version)


def _makes_many(row: Fact) -> bool:
    return row.fills_tuple and row.type is None


def _getter(place: str) -> Get:
    outer, _, field = place.rpartition(".")
    if not outer:
        return attrgetter(field)
    get_outer, get_inner = attrgetter(outer), attrgetter(field)

    def get(node: Any) -> Any:
        holder = get_outer(node)
        return None if holder is None else get_inner(holder)

    return get


def _places(row: Fact) -> Iterable[str]:
    """The fields that a hoisted container holds."""
    for inner in row.rows:
        if inner.place and inner.place != ".":
            yield inner.place
        if inner.place == "." or inner.type:
            yield from _places(inner)


def _format(row: Fact) -> Callable[[Any, Any], str]:
    """How to show a value: (node, value)."""
    place = row.place or ""

    def show_bool(node: Any, value: bool) -> str:
        spelt = node.spelling.get(place) if node.spelling else None
        return spelt if spelt is not None and parse_bool(spelt) == value else format_value(value)

    match row.type:
        case "double":
            return lambda _, value: format_number(value)
        case "string":
            return lambda _, value: value
        case "bool":
            return show_bool
        case _:
            return lambda _, value: format_value(value)


def _text(fact: Fact) -> Get | None:
    """The text of an element that is a node and has text: only poses do."""
    return _pose_text if fact.type == "pose" else None


def _pose_text(pose: Any) -> str | None:
    if pose.xyz is None and pose.rpy is None and pose.quat_xyzw is None:
        return None
    rotation = pose.quat_xyzw if pose.quat_xyzw is not None else pose.rpy or (0.0, 0.0, 0.0)
    return " ".join(map(format_number, (*(pose.xyz or (0.0, 0.0, 0.0)), *rotation)))


def _write_in_order(items: list[tuple[Any, Write]], element: XmlElement) -> None:
    """Write children by the line that they came from; one made by a pass follows the one before it."""
    keys: list[int] = []
    for child, _ in items:
        keys.append(child.source.line if child.source else keys[-1] if keys else 0)
    for index in sorted(range(len(items)), key=keys.__getitem__):
        child, write = items[index]
        write(child, element)


def _write_opaque(parts: Iterable[Any], element: XmlElement) -> None:
    for part in parts:
        holder = _holder(element, part.at)
        if part.element is not None:
            element_xml(part.element, holder)
        elif part.attribute is not None:
            holder.set(*part.attribute)
        else:
            holder.text = f"{holder.text} {part.text}" if holder.text else part.text


def _holder(element: XmlElement, path: str) -> XmlElement:
    for step in filter(None, path.split("/")):
        found = element.find(step)
        element = found if found is not None else etree.SubElement(element, step)
    return element
