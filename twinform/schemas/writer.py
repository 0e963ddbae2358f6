"""The schema writer, from the IR to XML: closures built once for each format and version from the reader's facts.

A writer writes the content of the node, in the order of the facts, and decides nothing. It knows nodes only by the
names of their fields. Children that came from a file keep the order that they had in it.
"""

from collections.abc import Callable, Generator, Iterable
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from operator import itemgetter
from typing import Any, TypeVar

from lxml import etree
from lxml.etree import SubElement

from twinform.schemas.facts import Fact, Table, Version, rows_by_name, table
from twinform.schemas.values import format_number, format_numbers, format_value, parse_bool
from twinform.schemas.xml import XmlElement

Write = Callable[[Any, XmlElement], None]
"""Writes a node's fields into an element: (node, element)"""
WriteValue = Callable[[Any, Any, XmlElement], None]
"""Writes one field into an element: (value, node, element)"""
Step = tuple[str, WriteValue]
"""A field, and what writes it where it is not None."""
_Each = TypeVar("_Each")
Show = Callable[[Any, Any], str]
"""The text of a value: (value, node)"""

_VECTORS = frozenset({"vector3", "vector2d", "quaternion", "color", "color4"})
_ALWAYS = "opaque"
"""A field that is never None, for steps that look at several fields themselves."""


Written = list[tuple[Any, XmlElement]]
"""Parts that were written, with the elements that they have become; an element may have been taken away again."""

_written: ContextVar[Written | None] = ContextVar("written", default=None)
"""Where what is written is noted; writers are shared, so that they cannot hold it themselves."""

LAST_LINE = 65535
"""libxml2 keeps no number beyond it."""


@contextmanager
def noted() -> Generator[Written]:
    """Note which elements the parts become that are written in the meantime."""
    written: Written = []
    token = _written.set(written)
    try:
        yield written
    finally:
        _written.reset(token)


def _note(part: Any, element: XmlElement) -> None:
    written = _written.get()
    if written is not None:
        written.append((part, element))


def element_xml(element: Any, parent: XmlElement | None = None) -> XmlElement:
    """The XML of an IR `Element`, below `parent` where one is given."""
    attributes = dict(element.attributes)
    made = etree.Element(element.name, attributes) if parent is None else SubElement(parent, element.name, attributes)
    made.text, made.tail = element.text, element.tail
    if element.source is not None:
        made.sourceline = min(element.source.line, LAST_LINE)  # pyright: ignore[reportAttributeAccessIssue] - it can be set
    _note(element, made)
    for child in element.children:
        element_xml(child, made)
    return made


class Writer:
    """Writes nodes in one format and version."""

    def __init__(self, facts: Table, version: Version) -> None:
        self.table = facts
        self.version = version
        self.writes: dict[str, Write] = {}
        """The writers of the definitions, and of the containers in them that were asked for, by their paths."""
        self.repeated: dict[str, tuple[str, ...]] = {}
        """The fields of each definition that hold several parts, in the order in which they are written."""
        for name, definition in facts.definitions.items():
            self.writes[name] = self._node(definition)
            self.repeated[name] = tuple(row.place or "" for row in self._rows(definition.rows) if makes_many(row))

    def write(self, node: Any, element: XmlElement, definition: str | None = None) -> None:
        """Write a node into an element that is there already; `definition` may go further in, as `joint/axis` does."""
        self._write_of(definition or self.table.root)(node, element)

    def _write_of(self, path: str) -> Write:
        if path not in self.writes:
            first, *steps = path.split("/")
            fact = self.table.definitions[first]
            for step in steps:
                fact = self.table.resolve(next(row for row in self._rows(fact.rows) if row.name == step))
            self.writes[path] = self._node(fact)
        return self.writes[path]

    def _node(self, fact: Fact) -> Write:
        """The writer of an element that is a node of its own."""
        rows = self._rows(fact.rows)
        steps = self._steps(rows)
        many = [(row.place or "", self._many(row)) for row in rows if makes_many(row)]
        text = _pose_text if fact.type == "pose" else None
        content = fact.place if fact.any else None

        def write(node: Any, element: XmlElement) -> None:
            _note(node, element)
            if text is not None:
                element.text = text(node)
            for field, write_value in steps:
                value = getattr(node, field)
                if value is not None:
                    write_value(value, node, element)
            if many:
                for child, write_one in in_order(
                    [(one, write_one) for field, write_one in many for one in getattr(node, field)]
                ):
                    write_one(child, element)
            if content is not None:
                for child in getattr(node, content):
                    element_xml(child, element)
            if node.opaque:
                _write_opaque(node.opaque, element)

        return write

    def _steps(self, rows: list[Fact]) -> list[Step]:
        """What writes the fields that are written once, in the order of the facts."""
        kinds = [row for row in rows if row.kind]
        steps = [self._step(row) for row in rows if not row.kind and not makes_many(row)]
        return [*steps, (kinds[0].place or "", self._kinds(kinds))] if kinds else steps

    def _rows(self, rows: list[Fact]) -> list[Fact]:
        return rows_to_write(rows, self.version)

    def _step(self, row: Fact) -> Step:
        outer, _, field = (row.place or "").rpartition(".")
        write = self._row(row)
        if row.place == "." or (row.type and self._rows(row.attributes)):
            return _ALWAYS, write
        if not outer:
            return field, write

        def write_inner(holder: Any, node: Any, element: XmlElement) -> None:
            value = getattr(holder, field)
            if value is not None:
                write(value, node, element)

        return outer, write_inner

    def _row(self, row: Fact) -> WriteValue:
        if row.is_attribute:
            return self._attribute(row)
        if row.type is not None:
            return self._leaf_with_attributes(row) if self._rows(row.attributes) else self._leaf(row)
        return self._hoisted(row) if row.place == "." else self._own_node(row)

    def _attribute(self, row: Fact) -> WriteValue:
        name, show = row.name[1:], _show(row)

        def write(value: Any, node: Any, element: XmlElement) -> None:
            element.set(name, show(value, node))

        return write

    def _inner(self, row: Fact) -> Write:
        if row.reference is None:
            return self._node(row)
        writes, name = self.writes, row.reference
        return lambda node, element: writes[name](node, element)  # noqa: PLW0108 - it may not be there yet

    def _leaf(self, row: Fact) -> WriteValue:
        name, show = row.name, _show(row)

        def write(value: Any, node: Any, element: XmlElement) -> None:
            SubElement(element, name).text = show(value, node)

        def write_each(values: Any, node: Any, element: XmlElement) -> None:
            for value in values:
                SubElement(element, name).text = show(value, node)

        return write_each if row.fills_tuple else write

    def _leaf_with_attributes(self, row: Fact) -> WriteValue:
        """The writer of a leaf that stands even where only one of its attributes is written."""
        name, show, field = row.name, _show(row), row.place or ""
        attributes = [(inner.place or "", self._attribute(inner)) for inner in self._rows(row.attributes)]

        def write(_: Any, node: Any, element: XmlElement) -> None:
            value, written = getattr(node, field), [each for each in attributes if getattr(node, each[0]) is not None]
            if value is None and not written:
                return
            leaf = SubElement(element, name)
            if value is not None:
                leaf.text = show(value, node)
            for place, write_attribute in written:
                write_attribute(getattr(node, place), node, leaf)

        return write

    def _hoisted(self, row: Fact) -> WriteValue:
        """The writer of a container that is no node: it stands where one of its fields is written."""
        name, steps, places = row.name, self._steps(self._rows(row.rows)), [p.split(".") for p in _places(row)]

        def write(_: Any, node: Any, element: XmlElement) -> None:
            if all(_value(node, place) is None for place in places):
                return
            made = SubElement(element, name)
            for field, write_value in steps:
                value = getattr(node, field)
                if value is not None:
                    write_value(value, node, made)

        return write

    def _own_node(self, row: Fact) -> WriteValue:
        """The writer of a child node that may be there once. One that is empty in this format is not written."""
        name, inner = row.name, self._inner(row)

        def write(child: Any, _: Any, element: XmlElement) -> None:
            made = SubElement(element, name)
            inner(child, made)
            if is_empty(made):
                element.remove(made)

        return write

    def _kinds(self, rows: list[Fact]) -> WriteValue:
        """The writer of a field that holds one of several kinds of node."""
        writes = {row.kind: (row.name, self._inner(row)) for row in rows}

        def write(child: Any, _: Any, element: XmlElement) -> None:
            if child.kind in writes:
                name, inner = writes[child.kind]
                inner(child, SubElement(element, name))

        return write

    def _many(self, row: Fact) -> Write:
        name, inner = row.name, self._inner(row)
        return lambda child, element: inner(child, SubElement(element, name))


@cache
def writer(format: str, version: Version) -> Writer:
    """The writer of a format in a version."""
    return Writer(table(format), version)


def rows_to_write(rows: Iterable[Fact], version: Version) -> list[Fact]:
    """One row with a place in the node for each name; this version's where it has one."""
    placed = (row for row in rows if row.place and row.place[0] != "/")
    return list(rows_by_name(placed, version).values())


def makes_many(row: Fact) -> bool:
    """Whether its field holds any number of nodes, which are written in the order of the file."""
    return row.fills_tuple and row.type is None


def is_empty(element: XmlElement) -> bool:
    """Whether an element has neither children, attributes nor text."""
    return not len(element) and not element.keys() and not element.text


def _value(node: Any, place: list[str]) -> Any:
    for field in place:
        node = None if node is None else getattr(node, field)
    return node


def _places(row: Fact) -> Iterable[str]:
    """The fields that a hoisted container holds."""
    for inner in row.rows:
        if inner.place and inner.place != ".":
            yield inner.place
        if inner.place == "." or inner.type:
            yield from _places(inner)


def _show(row: Fact) -> Show:
    place = row.place or ""

    def show_bool(value: bool, node: Any) -> str:
        # `1` and `true` are the same boolean and different text, so that a file comes out as it
        # went in. A spelling that no longer fits the value is not used: a pass has changed it.
        spelt = node.spelling.get(place) if node.spelling else None
        return spelt if spelt is not None and parse_bool(spelt) == value else format_value(value)

    if row.type == "bool":
        return show_bool
    if row.type == "string":
        return _show_text
    if row.type in _VECTORS:
        return _show_vector
    return _show_number if row.type == "double" else _show_value


def _show_text(value: str, _: Any) -> str:
    return value


def _show_number(value: float, _: Any) -> str:
    return format_number(value)


def _show_vector(value: tuple[float, ...], _: Any) -> str:
    return format_numbers(value)


def _show_value(value: Any, _: Any) -> str:
    return format_value(value)


def _pose_text(pose: Any) -> str | None:
    if pose.xyz is None and pose.rpy is None and pose.quat_xyzw is None:
        return None
    rotation = pose.quat_xyzw if pose.quat_xyzw is not None else pose.rpy or (0.0, 0.0, 0.0)
    return format_numbers((*(pose.xyz or (0.0, 0.0, 0.0)), *rotation))


def in_order(items: list[tuple[Any, _Each]]) -> list[tuple[Any, _Each]]:
    """Children by the line that they came from; one without a line of this file follows the one before it."""
    if len(items) < 2:
        return items
    keys: list[int] = []
    file, line = None, 0
    for child, _ in items:
        source = child.source
        if source is not None:
            file = source.file if file is None else file
            line = source.line if source.file == file else line
        # Links and joints are separate tuples in the IR, but most authors write them in turns.
        keys.append(line)
    return [item for _, item in sorted(zip(keys, items, strict=True), key=itemgetter(0))]


def _write_opaque(parts: Iterable[Any], element: XmlElement) -> None:
    for part in parts:
        holder = _holder(element, part.at)
        if part.element is not None:
            _note(part, element_xml(part.element, holder))
        elif part.attribute is not None:
            holder.set(*part.attribute)
        else:
            holder.text = f"{holder.text} {part.text}" if holder.text else part.text


def _holder(element: XmlElement, path: str) -> XmlElement:
    for step in filter(None, path.split("/")):
        found = element.find(step)
        element = found if found is not None else SubElement(element, step)
    return element
