"""The schema reader, from XML to dicts in the shape of the IR: closures built once for each format and version.

It validates while it reads: structure, cardinality, versions and values are checked on the way, and what has no
typed field is kept as opaque parts. The dicts hold IR field names and know nothing of the IR's classes.
"""

from collections.abc import Callable
from functools import cache
from typing import TypeVar

from twinform.diagnostics import Source
from twinform.schemas import messages
from twinform.schemas.facts import Fact, Table, Version, rows_by_name, table
from twinform.schemas.fast_path import GIVE_UP, quick_attributes, quick_parse, quick_pose
from twinform.schemas.messages import Context
from twinform.schemas.row_findings import ReadChild, with_row_findings
from twinform.schemas.untyped_parts import element_data, keep_element, keep_part, locate
from twinform.schemas.value_readers import attribute_reader, text_reader
from twinform.schemas.value_stores import Data
from twinform.schemas.values import VALUE_TYPES
from twinform.schemas.xml import XmlElement, is_blank

_INSTANCE = "{http://www.w3.org/2001/XMLSchema-instance}"
_OF_SCHEMAS = frozenset({_INSTANCE + "type", _INSTANCE + "nil"})
"""Foreign attributes that make an XSD engine check an element in another way."""

Fill = Callable[[XmlElement, Data, str, Context], None]
"""Reads the inside of an element into the dict of its node: (element, node, path from the node, context)"""

_Closure = TypeVar("_Closure")


class _Made(dict[str, _Closure]):
    """Closures by name, each made when it is first looked up."""

    def __init__(self, make: Callable[[str], _Closure]) -> None:
        super().__init__()
        self._make = make

    def __missing__(self, name: str) -> _Closure:
        made = self[name] = self._make(name)
        return made


class Reader:
    """Reads elements of one format in one version.

    Definitions refer to each other, so the closures look each other up when they are called. Each is made when it is
    first needed: a file has few of the elements that there are.
    """

    def __init__(self, facts: Table, version: Version) -> None:
        self.table = facts
        self.version = version
        self.types = VALUE_TYPES[facts.format]
        self.fills = _Made(lambda name: self._fill(facts.definitions[name], keep=True))
        self.checks = _Made(lambda name: self._fill(facts.definitions[name], keep=False))

    def read(
        self, element: XmlElement, context: Context, definition: str | None = None, source: Source | None = None
    ) -> Data:
        """The data of the node that an element makes; it is the format's root where no definition is named.

        `source` is where the element was written, if not where it stands.
        """
        if source is None:
            source = Source(context.file, element.sourceline or 0, None, str(element.tag), element.get("name"))
        node: Data = {"source": source}
        self.fills[definition or self.table.root](element, node, "", context)
        return node

    def _fill(self, fact: Fact, *, keep: bool) -> Fill:  # noqa: C901 - closures over one set of tables
        """The reader of an element's inside. Where `keep` is false it only checks."""
        attribute_rows = {name[1:]: row for name, row in rows_by_name(fact.attributes, self.version).items()}
        child_rows = rows_by_name(fact.children, self.version)
        attributes = _Made(lambda name: attribute_reader(attribute_rows[name], self.types, self.version, keep=keep))
        children = _Made(lambda name: self._child(child_rows[name], keep=keep))
        parses = [(row, quick_parse(row, self.types, self.version)) for row in fact.attributes if keep]
        quick = {row.name[1:]: (row.place or "", parse) for row, parse in parses if parse}
        present = [row for row in fact.rows if row.exists_in(self.version)]
        asked = [row for row in present if row.is_attribute and (row.required or row.expected)]
        needed_attributes = frozenset(row.name[1:] for row in asked)
        rows_asked = {row.name[1:]: row for row in asked}
        needed_children = frozenset(row.name for row in present if not row.is_attribute and row.required)
        once = frozenset(row.name for row in child_rows.values() if not row.repeats)
        free, content = fact.any, fact.place if fact.any and keep else None
        read_text = text_reader(fact, self.types, fact.place, keep=keep) if fact.type else None
        kinds = frozenset(row.name for row in fact.children if row.kind)

        def fill(element: XmlElement, node: Data, at: str, context: Context) -> None:  # noqa: C901 - the hot path
            for name, text in element.items():
                if name in quick:
                    place_of, parse = quick[name]
                    try:
                        node[place_of] = parse(text)
                        continue
                    except GIVE_UP:
                        pass
                if name in attribute_rows:
                    attributes[name](element, text, node, at, context)
                else:
                    other_attribute(element, name, text, node, at, context)
            if needed_attributes and not needed_attributes.issubset(element.keys()):
                for name in sorted(needed_attributes.difference(element.keys())):
                    messages.missing_attribute(context, element, rows_asked[name])
            text = element.text
            if read_text is not None:
                read_text(element, node, at, context)
            elif text and not (text.isspace() and text.isascii()):  # is_blank, without a call for each element
                stray(element, text, node, at, context)
            counts: dict[str, int] = {}
            for child in element:
                tag: str = child.tag  # pyright: ignore[reportAssignmentType] - the parser removes comments
                place = counts[tag] = counts.get(tag, 0) + 1
                if tag not in child_rows:
                    other_child(child, node, at, context)
                elif place > 1 and tag in once:
                    messages.repeated(context, child)
                    if keep:
                        keep_element(child, node, at, context)
                else:
                    children[tag](child, node, at, place, context)
                if not context.clean and content is None and not is_blank(child.tail or ""):
                    stray(element, child.tail or "", node, at, context, after=child)
            if kinds and len(kinds & counts.keys()) > 1:
                _other_kinds(element, kinds, context)
            if not needed_children.issubset(counts):
                for name in sorted(needed_children.difference(counts)):
                    messages.missing_child(context, element, name)

        def stray(
            element: XmlElement, text: str, node: Data, at: str, context: Context, after: XmlElement | None = None
        ) -> None:
            if not free:
                messages.stray_text(context, element, text, after)
            if keep:
                keep_part(element, node, context, {"at": at, "text": " ".join(text.split())})

        def other_child(child: XmlElement, node: Data, at: str, context: Context) -> None:
            if content is not None:
                node.setdefault(content, []).append(element_data(child, context, node.get("source")))
                return
            if not free and (read_text is not None or str(child.tag)[0] != "{"):
                messages.unknown_element(context, child, child_rows, attribute_rows)
            elif not free:
                messages.prefixed_element(context, child)
            if keep:
                keep_element(child, node, at, context)

        def other_attribute(element: XmlElement, name: str, text: str, node: Data, at: str, context: Context) -> None:
            if name[0] == "{":
                messages.prefixed_attribute(context, element, name)
            if name in _OF_SCHEMAS or (name[0] != "{" and not free):
                messages.unknown_attribute(context, element, name, attribute_rows, child_rows)
            if keep:
                keep_part(element, node, context, {"at": at, "attribute": (name, text)})

        return fill

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
        has_text = self.table.resolve(row).type is not None
        return with_row_findings(row, self.version, read, has_text=has_text, keep=keep)

    def _inner(self, row: Fact, *, keep: bool) -> Fill:
        if row.reference is None:
            return self._fill(row, keep=keep)
        fills, name = self.fills if keep else self.checks, row.reference

        def fill(element: XmlElement, node: Data, at: str, context: Context) -> None:
            fills[name](element, node, at, context)

        return fill

    def _checked(self, row: Fact) -> ReadChild:
        check = self._inner(row, keep=False)

        def read(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
            check(child, node, "", context)

        return read

    def _opaque(self, row: Fact) -> ReadChild:
        check = self._inner(row, keep=False)

        def read(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
            check(child, {}, "", context)
            keep_element(child, node, at, context)

        return read

    def _hoisted(self, row: Fact) -> ReadChild:
        """The reader of a container whose rows fill the node around it."""
        quick = quick_attributes(self.table.resolve(row), self.types, self.version)
        fill, name = self._inner(row, keep=True), row.name

        def read(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
            if quick is not None and context.simple and quick(child, node):
                return
            if len(child) or child.keys() or not is_blank(child.text or ""):
                fill(child, node, f"{at}/{name}" if at else name, context)
            else:
                fill(child, {}, "", context)
                keep_element(child, node, at, context)

        return read

    def _own_node(self, row: Fact, field: str) -> ReadChild:
        """The reader of an element that makes a node."""
        fact = self.table.resolve(row)
        quick = quick_pose(fact, self.types) or quick_attributes(fact, self.types, self.version)
        fill, name, kind, repeats = self._inner(row, keep=True), row.name, row.kind, row.repeats
        check = self._inner(row, keep=False)
        outer, _, inner = field.rpartition(".")
        fills_tuple = row.fills_tuple
        is_named = any(inner_row.name == "@name" for inner_row in fact.rows)

        def read(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
            key = (child.get("name") if is_named else None) or (place if repeats else None)
            above, line = node["source"], child.sourceline or 0
            data: Data = {"source": locate(Source, (context.file, line, above, f"{at}/{name}" if at else name, key))}
            if kind is not None:
                data["kind"] = kind
                if field in node:
                    check(child, {}, "", context)
                    keep_element(child, node, at, context)
                    return
            if quick is None or not context.simple or not quick(child, data):
                fill(child, data, "", context)
            holder = node if not outer else node.setdefault(outer, {"source": data["source"]})
            if fills_tuple:
                holder.setdefault(inner, []).append(data)
            elif len(data) > 1:
                holder[inner] = data
            else:  # it is empty, so the field stays unwritten
                keep_element(child, node, at, context)

        return read

    def _leaf(self, row: Fact, place: str) -> ReadChild:
        """The reader of an element with text, and perhaps attributes, whose value is a field of the node around it."""
        fill, name, field = self._fill(row, keep=True), row.name, place
        read_text = text_reader(row, self.types, place, keep=True)
        parse = quick_parse(row, self.types, self.version) if row.type != "string" and not row.attributes else None

        def read(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
            if parse is not None and context.simple:
                try:
                    node[field] = parse(child.text)
                except (*GIVE_UP, AttributeError):
                    pass
                else:
                    return
            if child.keys() or len(child):
                fill(child, node, f"{at}/{name}" if at else name, context)
            elif not read_text(child, node, at, context):
                keep_element(child, node, at, context)

        return read


@cache
def reader(format: str, version: Version) -> Reader:
    """The reader of a format in a version."""
    return Reader(table(format), version)


def _other_kinds(element: XmlElement, kinds: frozenset[str], context: Context) -> None:
    """Report the children that are of another kind than the first, where an element has one of several."""
    found = [child for child in element if child.tag in kinds]
    for child in found:
        if child.tag != found[0].tag:
            messages.repeated(context, child)
