"""The reader: from an XML tree to nodes of the IR by the facts tables, with every finding about what they say.

One walk in the order of the file reads, checks and reports: structure, cardinality, versions and values. What has no
typed field is kept as opaque parts.

An `ElementReader` reads the inside of one element: its attributes, then its text, then its children, each by the
function of its row (`ReadAttribute`, `ReadText`, `ReadChild`), which is made from the row when a file first needs it.
The values of a node gather in a dict, which begins with its `source`; a `NodeMaker` makes the node of it once its
element is read. What makes no node of its own, such as a leaf, writes into the dict of the node around it.
"""

from collections.abc import Iterator
from functools import cache, partial

from twinform.diagnostics import Source
from twinform.ir import Document, Model, Node
from twinform.ir.versions import Version
from twinform.schemas import messages
from twinform.schemas.element_reader import ElementReader, ReadChild, with_row_findings
from twinform.schemas.facts import Fact, Table, table
from twinform.schemas.messages import Context
from twinform.schemas.value_readers import Data, NodeMaker, keep_element, locate, node_class, require_place, text_reader
from twinform.schemas.value_types import VALUE_TYPES
from twinform.schemas.xml import XmlElement, is_blank, is_followed

_ROOTS: dict[str, type[Node]] = {"urdf": Model, "sdf": Document, "mjcf": Document}
"""The class of the node that the root element of a format makes."""


class SchemaReader:
    """Reads elements of one format in one version.

    A file has few of the elements that there are, and definitions refer to each other, so nothing is made before it is
    needed.
    """

    def __init__(self, facts: Table, version: Version) -> None:
        self.table = facts
        self.version = version
        self.types = VALUE_TYPES[facts.format]
        self._definitions: dict[tuple[str, type[Node] | None, str], ElementReader] = {}
        self._makers: dict[tuple[str, type[Node]], NodeMaker] = {}

    def read(
        self,
        element: XmlElement,
        context: Context,
        definition: str | None = None,
        kind: type[Node] | None = None,
        source: Source | None = None,
    ) -> Data:
        """The values of the node that an element makes, with all nodes inside it made.

        The element is of a definition, and its node of the class `kind`; without them, they are those of the format's
        root. `source` is where the element was written, if not where it stands. If a node lacks what it needs, the
        context is `broken` afterwards.
        """
        fact, kind = self.table.definitions[definition or self.table.root], kind or _ROOTS[self.table.format]
        if source is None:
            source = Source(context.file, element.sourceline or 0, None, str(element.tag), element.get("name"))
        data: Data = {"source": source}
        # No validation by Pydantic follows. All that it could refuse is a node without a required
        # field, or with a word that its class does not have, and for these there is a finding.
        self._definition(fact.name, kind, "").read(element, data, context, 1)
        key = fact.name, kind
        if key not in self._makers:
            self._makers[key] = self._maker(fact, kind)
        self._makers[key].complete(data)
        return data

    def _definition(self, name: str, into: type[Node] | None, at: str) -> ElementReader:
        key = name, into, at
        if key not in self._definitions:
            self._definitions[key] = self._element_reader(self.table.definitions[name], into, at)
        return self._definitions[key]

    def _inside(self, row: Fact, into: type[Node] | None, at: str = "") -> ElementReader:
        """Return the reader of the inside of a row's element, for a node of a class; without one it only checks.

        `at` is the path from the node's own element to this one.
        """
        return self._definition(row.reference, into, at) if row.reference else self._element_reader(row, into, at)

    def _element_reader(self, fact: Fact, into: type[Node] | None, at: str) -> ElementReader:
        if into is not None:
            for place in filter(None, (row.place for row in fact.rows)):
                require_place(Document if place.startswith("/") else into, place)
        return ElementReader(fact, self.types, self.version, partial(self._child, into=into, at=at), into, at)

    def _child(self, row: Fact, into: type[Node] | None, at: str) -> ReadChild:
        """Return the reader of a row's element at a path from the current node."""
        if into is None:
            read = self._checked(row)
        elif row.place is None:
            read = self._opaque(row, at)
        elif row.type is not None:
            read = self._leaf(row, into, at)
        elif row.place == ".":
            read = self._hoisted(row, into, at)
        else:
            read = self._own_node(row, row.place, into, at)
        if row.last:
            read = _last_alone(read)
        has_text = self.table.resolve(row).type is not None
        return with_row_findings(row, self.version, read, at, has_text=has_text, keep=into is not None)

    def _checked(self, row: Fact) -> ReadChild:
        """Return the reader of an element that is checked and fills no field."""
        return self._inside(row, None).read if row.type is None or row.rows else self._leaf(row, None, "")

    def _opaque(self, row: Fact, at: str) -> ReadChild:
        check = self._checked(row)

        def read(child: XmlElement, node: Data, context: Context, place: int) -> None:
            check(child, node, context, place)
            if context.keeps:
                keep_element(child, node, at, context)

        return read

    def _leaf(self, row: Fact, into: type[Node] | None, at: str) -> ReadChild:
        """Return the reader of an element with text, perhaps attributes, that fills a field of the node around it."""
        keep, has_rows = into is not None, bool(row.rows)
        read_text = text_reader(row, self.types, keep=keep)
        inside = cache(partial(self._element_reader, row, into, _below(at, row)))

        def read(child: XmlElement, node: Data, context: Context, place: int) -> None:
            if (has_rows or not context.simple) and (child.keys() or len(child)):
                inside().read(child, node, context, place)
            elif not read_text(child, node, context) and keep:
                keep_element(child, node, at, context)

        return read

    def _hoisted(self, row: Fact, into: type[Node], at: str) -> ReadChild:
        """Return the reader of a container whose rows fill the node around it."""
        fill = self._inside(row, into, _below(at, row)).read
        whole, last = self._opaque(row, at), frozenset(each.name for each in row.rows if each.last)

        def read(child: XmlElement, node: Data, context: Context, place: int) -> None:
            # What is not the last stands before what is, and fields are written before what has none.
            if last and any(each.tag in last and is_followed(each) for each in child):
                whole(child, node, context, place)
            elif len(child) or child.keys() or not is_blank(child.text or ""):
                fill(child, node, context, place)
            else:
                fill(child, {"source": node["source"]}, context, place)
                keep_element(child, node, at, context)

        return read

    def _own_node(self, row: Fact, place: str, into: type[Node], at: str) -> ReadChild:
        """Return the reader of an element that makes a node."""
        outer, _, field = place.rpartition(".")
        kind = node_class(node_class(into, outer) if outer else into, field, row.kind)
        if row.kind:
            return self._one_of_several(row, kind, field, at)
        fact = self.table.resolve(row)
        fill, maker = self._inside(row, kind).read, self._maker(fact, kind)
        gathers, complete, make = maker.gathers, maker.complete, maker.make
        step, repeats, fills_tuple = _below(at, row), row.repeats, row.fills_tuple
        is_named = any(inner_row.name == "@name" for inner_row in fact.rows)

        def read(child: XmlElement, node: Data, context: Context, place: int) -> None:
            # Sources are found by name where there is one: a finding's path stays right when a part
            # before it is removed.
            key = (child.get("name") if is_named else None) or (place if repeats else None)
            data: Data = {"source": locate(Source, (context.file, child.sourceline or 0, node["source"], step, key))}
            fill(child, data, context, place)
            if gathers or "opaque" in data:
                complete(data)
            holder = node if not outer else node.setdefault(outer, {"source": data["source"]})
            if fills_tuple:
                holder.setdefault(field, []).append(make(data))
            elif len(data) > 1:
                holder[field] = make(data)
            else:  # it is empty, so the field stays unwritten
                keep_element(child, node, at, context)

        return read

    def _one_of_several(self, row: Fact, kind: type[Node], field: str, at: str) -> ReadChild:
        """Return the reader of an element that makes a node of a kind, unless the field has one already."""
        fill, maker = self._inside(row, kind).read, self._maker(self.table.resolve(row), kind)
        gathers, complete, make = maker.gathers, maker.complete, maker.make
        keep, step = self._opaque(row, at), _below(at, row)

        def read(child: XmlElement, node: Data, context: Context, place: int) -> None:
            if field in node:
                keep(child, node, context, place)
                return
            source = locate(Source, (context.file, child.sourceline or 0, node["source"], step, None))
            data: Data = {"source": source, "kind": row.kind}
            fill(child, data, context, place)
            if gathers or "opaque" in data:
                complete(data)
            node[field] = make(data)

        return read

    def _maker(self, fact: Fact, kind: type[Node]) -> NodeMaker:
        outer = dict.fromkeys(place.partition(".")[0] for place in self._places(fact) if "." in place)
        return NodeMaker(kind, {field: node_class(kind, field) for field in outer})

    def _places(self, fact: Fact) -> Iterator[str]:
        """Return the places of the rows that fill the node of a fact, also of containers without a node."""
        for row in fact.rows:
            if row.place == "." and row.type is None:
                yield from self._places(self.table.resolve(row))
            elif row.place and not row.place.startswith("/"):
                yield row.place


def _below(at: str, row: Fact) -> str:
    """Return the path to a row's element inside the one at a path."""
    return f"{at}/{row.name}" if at else row.name


def _last_alone(read: ReadChild) -> ReadChild:
    """Return the reader of an element that skips it where another one of its name follows."""

    def read_last(child: XmlElement, node: Data, context: Context, place: int) -> None:
        if is_followed(child):
            messages.repeated(context, child)
        else:
            read(child, node, context, place)

    return read_last


@cache
def reader(format: str, version: Version) -> SchemaReader:
    """Return the reader of a format in a version."""
    return SchemaReader(table(format), version)
