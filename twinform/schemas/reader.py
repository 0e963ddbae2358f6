"""The schema reader, from XML to dicts in the shape of the IR: closures built once for each format and version.

It validates while it reads: structure, cardinality, versions and values are checked on the way, and what has no
typed field is kept as opaque parts. The dicts hold IR field names and know nothing of the IR's classes.
"""

from collections.abc import Callable
from functools import cache, partial

from twinform.diagnostics import Source
from twinform.schemas.element_reader import ElementReader, Made
from twinform.schemas.facts import Fact, Table, Version, rows_by_name, table
from twinform.schemas.fast_path import UsualElement
from twinform.schemas.messages import Context
from twinform.schemas.row_findings import ReadChild, with_row_findings
from twinform.schemas.untyped_parts import keep_element, locate
from twinform.schemas.value_readers import text_reader
from twinform.schemas.value_stores import Data
from twinform.schemas.values import VALUE_TYPES
from twinform.schemas.xml import XmlElement, is_blank

Fill = Callable[[XmlElement, Data, str, Context], None]
"""Reads the inside of an element into the dict of its node: (element, node, path from the node, context)"""


class Reader:
    """Reads elements of one format in one version.

    Definitions refer to each other, so the closures look each other up when they are called. Each is made when it is
    first needed: a file has few of the elements that there are.
    """

    def __init__(self, facts: Table, version: Version) -> None:
        self.table = facts
        self.version = version
        self.types = VALUE_TYPES[facts.format]
        self.elements = Made(self._element_at)
        self.fills = Made(lambda name: self.fill(facts.definitions[name], keep=True))
        self.checks = Made(lambda name: self.fill(facts.definitions[name], keep=False))
        self.usual = Made(lambda name: self._usual(facts.definitions[name]))

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

    def element_reader(self, fact: Fact, *, keep: bool) -> ElementReader:
        """The reader of an element's inside. Where `keep` is false it only checks."""
        read_child = partial(self._child, keep=keep)
        return ElementReader(fact, self.types, self.version, read_child, keep=keep)

    def fill(self, fact: Fact, *, keep: bool) -> Fill:
        """The same as a function."""
        return self.element_reader(fact, keep=keep).read

    def _element_at(self, path: str) -> ElementReader:
        """The reader of the inside of an element by its path from a definition, such as `link/inertial`."""
        definition, *steps = path.split("/")
        fact = self.table.definitions[definition]
        for step in steps:
            fact = self.table.resolve(rows_by_name(fact.children, self.version)[step])
        return self.element_reader(fact, keep=True)

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
            return self.fill(row, keep=keep)
        fills, name = self.fills if keep else self.checks, row.reference

        def fill(element: XmlElement, node: Data, at: str, context: Context) -> None:
            fills[name](element, node, at, context)

        return fill

    def _checked(self, row: Fact) -> ReadChild:
        check = self._inner(row, keep=False)

        def read(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
            check(child, node, "", context)

        return read

    def _check(self, row: Fact) -> Callable[[XmlElement, Context], None]:
        """What reports the findings in an element of which nothing goes into fields."""
        check, usual = self._inner(row, keep=False), self._usual_of(row)

        def look(child: XmlElement, context: Context) -> None:
            if not usual.holds(child, context):
                check(child, {}, "", context)

        return look

    def _usual(self, fact: Fact) -> UsualElement:
        return UsualElement(fact, self.types, self.version, self._usual_of)

    def _usual_of(self, row: Fact) -> UsualElement:
        return self.usual[row.reference] if row.reference else self._usual(row)

    def _opaque(self, row: Fact) -> ReadChild:
        check = self._check(row)

        def read(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
            check(child, context)
            keep_element(child, node, at, context)

        return read

    def _hoisted(self, row: Fact) -> ReadChild:
        """The reader of a container whose rows fill the node around it."""
        fill, name = self._inner(row, keep=True), row.name

        def read(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
            if len(child) or child.keys() or not is_blank(child.text or ""):
                fill(child, node, f"{at}/{name}" if at else name, context)
            else:
                fill(child, {}, "", context)
                keep_element(child, node, at, context)

        return read

    def _own_node(self, row: Fact, field: str) -> ReadChild:
        """The reader of an element that makes a node."""
        fact = self.table.resolve(row)
        fill, name, kind, repeats = self._inner(row, keep=True), row.name, row.kind, row.repeats
        check = self._check(row)
        outer, _, inner = field.rpartition(".")
        fills_tuple = row.fills_tuple
        is_named = any(inner_row.name == "@name" for inner_row in fact.rows)

        def read(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
            if kind is not None and field in node:
                check(child, context)
                keep_element(child, node, at, context)
                return
            # Sources are found by name where there is one: a finding's path stays right when a part
            # before it is removed.
            key = (child.get("name") if is_named else None) or (place if repeats else None)
            above, line = node["source"], child.sourceline or 0
            data: Data = {"source": locate(Source, (context.file, line, above, f"{at}/{name}" if at else name, key))}
            if kind is not None:
                data["kind"] = kind
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
        fill, name = self.fill(row, keep=True), row.name
        read_text = text_reader(row, self.types, place, keep=True)

        def read(child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
            if child.keys() or len(child):
                fill(child, node, f"{at}/{name}" if at else name, context)
            elif not read_text(child, node, at, context):
                keep_element(child, node, at, context)

        return read


@cache
def reader(format: str, version: Version) -> Reader:
    """The reader of a format in a version."""
    return Reader(table(format), version)
