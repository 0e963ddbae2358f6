"""From XML to plain dicts in the shape of the IR: closures built once for each format and version from its facts.

Reading is also the table pass: structure, cardinality, versions and values are checked on the way, and what has no
typed field is kept as opaque parts. The dicts hold IR field names and know nothing of the IR's classes.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

from twinform.diagnostics import Location
from twinform.schemas import messages
from twinform.schemas.facts import Fact, Table, Version, table
from twinform.schemas.messages import Context
from twinform.schemas.values import VALUE_TYPES
from twinform.schemas.xml import XmlElement, is_blank, step_of

_INSTANCE = "{http://www.w3.org/2001/XMLSchema-instance}"
_OF_SCHEMAS = frozenset({_INSTANCE + "type", _INSTANCE + "nil"})
"""Foreign attributes that make an XSD engine check an element in another way."""

Data = dict[str, Any]
Fill = Callable[[XmlElement, Data, str, str, Context], None]
"""Reads the inside of an element into the dict of its node: (element, node, path from the node, path, context)"""
ReadAttribute = Callable[[XmlElement, str, Data, str, Context], None]
"""Reads an attribute: (element, text, node, path from the node, context)"""
ReadChild = Callable[[XmlElement, Data, str, str, int, Context], None]
"""Reads a child: (child, node, path from the node to the parent, path of the parent, place among its like, context)"""
Store = Callable[[XmlElement, Data, Any, Context], None]
"""Puts a value into a node: (element, node, value, context)"""


def element_data(element: XmlElement, context: Context) -> Data:
    """The subtree as data for the IR's `Element`."""
    tag = str(element.tag)
    note_namespaces(element, context)
    data: Data = {"name": tag}
    if element.attrib:
        data["attributes"] = tuple(element.items())
    if element.text and not element.text.isspace():
        data["text"] = element.text.strip()
    if element.tail and not element.tail.isspace():
        data["tail"] = element.tail.strip()
    if len(element):
        data["children"] = tuple([element_data(child, context) for child in element])
    return data


def note_namespaces(element: XmlElement, context: Context) -> None:
    """Remember the prefixes that an element declares, so that they can be written again."""
    if element.nsmap:
        context.namespaces.update({prefix: uri for prefix, uri in element.nsmap.items() if prefix})


class Reader:
    """Reads elements of one format in one version.

    Definitions refer to each other, so the closures look each other up when they are called.
    """

    def __init__(self, facts: Table, version: Version) -> None:
        self.table = facts
        self.version = version
        self.types = VALUE_TYPES[facts.format]
        self.fills: dict[str, Fill] = {}
        self.checks: dict[str, Fill] = {}
        for name, definition in facts.definitions.items():
            self.fills[name] = self._fill(definition, keep=True)
            self.checks[name] = self._fill(definition, keep=False)

    def read(self, element: XmlElement, context: Context, definition: str | None = None) -> Data:
        """The data of the node that an element makes; it is the format's root where no definition is named."""
        path = f"/{step_of(element)}"
        node: Data = {"source": Location(context.file, element.sourceline or 0, path)}
        self.fills[definition or self.table.root](element, node, "", path, context)
        return node

    def _fill(self, fact: Fact, *, keep: bool) -> Fill:
        """The reader of an element's inside. Where `keep` is false it only checks."""
        attributes = {row.name[1:]: self._attribute(row, keep=keep) for row in self._rows(fact.attributes)}
        children = {row.name: self._child(row, keep=keep) for row in self._rows(fact.children)}
        present = [row for row in fact.rows if row.exists_in(self.version)]
        needed_attributes = tuple(row.name[1:] for row in present if row.is_attribute and row.required)
        needed_children = tuple(row.name for row in present if not row.is_attribute and row.required)
        once = frozenset(row.name for row in self._rows(fact.children) if not row.repeats)
        free, content = fact.any, fact.place if fact.any and keep else None
        read_text = self._text(fact, fact.place, keep=keep) if fact.type else None
        kinds = frozenset(row.name for row in fact.children if row.kind)

        def fill(element: XmlElement, node: Data, at: str, path: str, context: Context) -> None:
            for name, text in element.items():
                read = attributes.get(name)
                if read is not None:
                    read(element, text, node, at, context)
                else:
                    other_attribute(element, name, text, node, at, context)
            for name in needed_attributes:
                if name not in element.attrib:
                    messages.missing_attribute(context, element, name)
            text = element.text
            if read_text is not None:
                read_text(element, node, at, context)
            elif text and not is_blank(text):
                stray(element, text, node, at, context)
            counts: dict[str, int] = {}
            for child in element:
                tag: str = child.tag  # pyright: ignore[reportAssignmentType] - the parser removes comments
                place = counts[tag] = counts.get(tag, 0) + 1
                read_child = children.get(tag)
                if read_child is None:
                    other_child(child, node, at, context)
                elif place > 1 and tag in once:
                    messages.repeated(context, child)
                    if keep:
                        _keep_element(child, node, at, context)
                else:
                    read_child(child, node, at, path, place, context)
                tail = child.tail
                if tail and not is_blank(tail) and content is None:
                    stray(element, tail, node, at, context, after=child)
            if kinds and len(kinds & counts.keys()) > 1:
                _other_kinds(element, kinds, context)
            for name in needed_children:
                if name not in counts:
                    messages.missing_child(context, element, name)

        def stray(
            element: XmlElement, text: str, node: Data, at: str, context: Context, after: XmlElement | None = None
        ) -> None:
            if not free:
                messages.stray_text(context, element, text, after)
            if keep:
                _keep(node, {"at": at, "text": " ".join(text.split())})

        def other_child(child: XmlElement, node: Data, at: str, context: Context) -> None:
            if content is not None:
                node.setdefault(content, []).append(element_data(child, context))
                return
            if not free and (read_text is not None or str(child.tag)[0] != "{"):
                messages.unknown_element(context, child, children)
            if keep:
                _keep_element(child, node, at, context)

        def other_attribute(element: XmlElement, name: str, text: str, node: Data, at: str, context: Context) -> None:
            if name[0] == "{":
                note_namespaces(element, context)
            if name in _OF_SCHEMAS or (name[0] != "{" and not free):
                messages.unknown_attribute(context, element, name, attributes)
            if keep:
                _keep(node, {"at": at, "attribute": (name, text)})

        return fill

    def _rows(self, rows: list[Fact]) -> list[Fact]:
        """One row for each name: the one of this version, or else the last of another."""
        best: dict[str, Fact] = {}
        for row in rows:
            if row.name not in best or not best[row.name].exists_in(self.version):
                best[row.name] = row
        return list(best.values())

    def _attribute(self, row: Fact, *, keep: bool) -> ReadAttribute:
        value_type = self.types[row.type or "string"]
        parse, check = value_type.parse, _check(row)
        late, name = not row.exists_in(self.version), row.name[1:]
        store = _store(row, row.place) if keep and row.place else None

        def read(element: XmlElement, text: str, node: Data, at: str, context: Context) -> None:
            if late:
                messages.outside_version(context, element, row)
            try:
                value = parse(text)
            except ValueError:
                messages.invalid_value(context, element, row.name, text, value_type.expected)
                return
            if check is not None:
                check(element, value, context)
            if store is not None:
                store(element, node, (value, text), context)
            elif keep:
                _keep(node, {"at": at, "attribute": (name, text)})

        return read

    def _child(self, row: Fact, *, keep: bool) -> ReadChild:
        if not keep:
            read = self._checked(row)
        elif row.place is None:
            read = self._opaque(row)
        elif row.type is not None:
            read = self._leaf(row, row.place)
        elif row.place == ".":
            read = self._hoisted(row)
        else:
            read = self._own_node(row, row.place)
        return read if row.exists_in(self.version) else _late(row, read)

    def _inner(self, row: Fact, *, keep: bool) -> Fill:
        if row.reference is None:
            return self._fill(row, keep=keep)
        fills, name = self.fills if keep else self.checks, row.reference

        def fill(element: XmlElement, node: Data, at: str, path: str, context: Context) -> None:
            fills[name](element, node, at, path, context)

        return fill

    def _checked(self, row: Fact) -> ReadChild:
        check = self._inner(row, keep=False)

        def read(child: XmlElement, node: Data, at: str, path: str, place: int, context: Context) -> None:  # noqa: ARG001 - all readers have one signature
            check(child, node, "", path, context)

        return read

    def _opaque(self, row: Fact) -> ReadChild:
        check = self._inner(row, keep=False)

        def read(child: XmlElement, node: Data, at: str, path: str, place: int, context: Context) -> None:  # noqa: ARG001 - all readers have one signature
            check(child, {}, "", path, context)
            _keep_element(child, node, at, context)

        return read

    def _hoisted(self, row: Fact) -> ReadChild:
        """The reader of a container whose rows fill the node around it."""
        fill, name = self._inner(row, keep=True), row.name

        def read(child: XmlElement, node: Data, at: str, path: str, place: int, context: Context) -> None:  # noqa: ARG001 - all readers have one signature
            if len(child) or child.attrib or child.text:
                fill(child, node, f"{at}/{name}" if at else name, f"{path}/{name}", context)
            else:
                fill(child, {}, "", path, context)
                _keep_element(child, node, at, context)

        return read

    def _own_node(self, row: Fact, field: str) -> ReadChild:
        """The reader of an element that makes a node."""
        fill, name, kind, repeats = self._inner(row, keep=True), row.name, row.kind, row.repeats
        outer, _, inner = field.rpartition(".")
        fills_tuple = row.fills_tuple

        def read(child: XmlElement, node: Data, at: str, path: str, place: int, context: Context) -> None:
            called = child.get("name")
            if called is not None:
                path = f"{path}/{name}[@name='{called}']"
            else:
                path = f"{path}/{name}[{place}]" if repeats else f"{path}/{name}"
            data: Data = {"source": Location(context.file, child.sourceline or 0, path)}
            if kind is not None:
                data["kind"] = kind
                if field in node:
                    _keep_element(child, node, at, context)
                    return
            fill(child, data, "", path, context)
            holder = node if not outer else node.setdefault(outer, {"source": data["source"]})
            if fills_tuple:
                holder.setdefault(inner, []).append(data)
            elif len(data) > 1:
                holder[inner] = data
            else:  # it says nothing, so the field stays unwritten
                _keep_element(child, node, at, context)

        return read

    def _leaf(self, row: Fact, place: str) -> ReadChild:
        """The reader of an element with text, and perhaps attributes, whose value is a field of the node around it."""
        fill, name = self._fill(row, keep=True), row.name
        read_text = self._text(row, place, keep=True)

        def read(child: XmlElement, node: Data, at: str, path: str, place: int, context: Context) -> None:  # noqa: ARG001 - all readers have one signature
            if child.attrib or len(child):
                fill(child, node, f"{at}/{name}" if at else name, f"{path}/{name}", context)
            elif not read_text(child, node, at, context):
                _keep_element(child, node, at, context)

        return read

    def _text(self, row: Fact, place: str | None, *, keep: bool) -> Callable[[XmlElement, Data, str, Context], bool]:
        """The reader of an element's text; it says whether there was any. Blank text means the default."""
        value_type = self.types[row.type or "string"]
        parse, check, is_string, needed = value_type.parse, _check(row), row.type == "string", row.needs_text
        store = _store(row, place) if keep and place else None

        def read(element: XmlElement, node: Data, at: str, context: Context) -> bool:  # noqa: ARG001 - the signature of a text reader
            text = element.text or ""
            if is_string:
                text = text.strip(" \t\r\n")
            elif is_blank(text):
                if needed:
                    messages.missing_text(context, element, value_type.expected)
                return False
            try:
                value = parse(text)
            except ValueError:
                messages.invalid_value(context, element, "", text.strip(), value_type.expected)
                return True
            if check is not None:
                check(element, value, context)
            if store is not None:
                store(element, node, (value, text), context)
            return True

        return read


@cache
def reader(format: str, version: Version) -> Reader:  # noqa: A002 - the word of the domain
    """The reader of a format in a version."""
    return Reader(table(format), version)


def _other_kinds(element: XmlElement, kinds: frozenset[str], context: Context) -> None:
    """Report the children that are of another kind than the first, where an element has one of several."""
    found = [child for child in element if child.tag in kinds]
    for child in found:
        if child.tag != found[0].tag:
            messages.repeated(context, child)


def _late(row: Fact, read: ReadChild) -> ReadChild:
    """The same reader for an element of another version: it is reported first."""

    def read_late(child: XmlElement, node: Data, at: str, path: str, place: int, context: Context) -> None:
        messages.outside_version(context, child, row)
        read(child, node, at, path, place, context)

    return read_late


def _keep(node: Data, part: Data) -> None:
    node.setdefault("opaque", []).append(part)


def _keep_element(child: XmlElement, node: Data, at: str, context: Context) -> None:
    _keep(node, {"at": at, "element": element_data(child, context) | {"tail": None}})


def _check(row: Fact) -> Callable[[XmlElement, Any, Context], None] | None:
    """What is asked of a value beyond its type."""
    if row.enum:
        allowed = frozenset(row.enum)

        def check_word(element: XmlElement, value: str, context: Context) -> None:
            if value not in allowed:
                step = row.name if row.is_attribute else ""
                messages.invalid_value(context, element, step, value, f"one of {', '.join(row.enum)}")

        return check_word
    if row.min is None and row.max is None:
        return None
    low = row.min if row.min is not None else float("-inf")
    high = row.max if row.max is not None else float("inf")

    def check_range(element: XmlElement, value: float | tuple[float, ...], context: Context) -> None:
        for number in value if isinstance(value, tuple) else (value,):
            if number < low or number > high:
                messages.out_of_range(context, element, row, number)

    return check_range


def _store(row: Fact, place: str) -> Store:
    """Puts a value, which comes with its text, where the IR has it."""
    outer, _, field = place.rpartition(".")

    def store_pose(element: XmlElement, node: Data, read: tuple[tuple[float, ...], str], context: Context) -> None:  # noqa: ARG001 - all stores have one signature
        values = read[0]
        node["xyz"] = values[:3]
        node["rpy" if len(values) == 6 else "quat_xyzw"] = values[3:]  # noqa: PLR2004 - three angles

    def store_repeated(element: XmlElement, node: Data, read: tuple[object, str], context: Context) -> None:  # noqa: ARG001
        node.setdefault(field, []).append(read[0])

    def store_inside(element: XmlElement, node: Data, read: tuple[object, str], context: Context) -> None:
        source = Location(context.file, element.sourceline or 0, node["source"].path)
        node.setdefault(outer, {"source": source})[field] = read[0]

    def store_header(element: XmlElement, node: Data, read: tuple[object, str], context: Context) -> None:  # noqa: ARG001
        context.header[place[1:]] = read[0]

    def store_bool(element: XmlElement, node: Data, read: tuple[object, str], context: Context) -> None:  # noqa: ARG001
        node[field], text = read
        if text not in ("true", "false"):
            node.setdefault("spelling", {})[field] = text.strip()

    def store(element: XmlElement, node: Data, read: tuple[object, str], context: Context) -> None:  # noqa: ARG001
        node[field] = read[0]

    if place.startswith("/"):
        return store_header
    if row.type == "pose":
        return store_pose
    if outer:
        return store_inside
    if row.repeats:
        return store_repeated
    return store_bool if row.type == "bool" else store
