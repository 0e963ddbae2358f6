"""Reads the inside of one element by its facts, and reports every finding that there is about it."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, TypeVar

from twinform.ir import Node
from twinform.ir.versions import Version
from twinform.schemas import messages
from twinform.schemas.facts import Fact, rows_by_name
from twinform.schemas.messages import Context
from twinform.schemas.value_readers import (
    SCALARS,
    Data,
    Types,
    attribute_reader,
    keep_attribute,
    keep_content,
    keep_element,
    keep_text,
    own_field,
    required_words,
    stand_in,
    stripped,
    text_reader,
)
from twinform.schemas.xml import BLANKS, XmlElement, is_blank

ReadChild = Callable[[XmlElement, Data, Context, int], None]
"""Reads a child: (child, values of the node around it, context, place among its like)"""


def with_row_findings(
    row: Fact, version: Version, read: ReadChild, at: str, *, has_text: bool, keep: bool
) -> ReadChild:
    """The reader of a child in a version, with the diagnostics of every such child.

    `at` is the path from the node to the element around it, `has_text` whether its element has text by the facts, and
    `keep` whether what has no field is kept.
    """
    if row.deprecated and row.exists_in(version):
        return _after(messages.deprecated, read)
    if row.dialect:
        dialect = row.dialect
        return _after(lambda context, child: messages.dialect_element(context, child, dialect), _aside(read))
    if row.aside:
        return _aside(read)
    if row.exists_in(version):
        return read
    read_other = _after(lambda context, child: messages.outside_version(context, child, row), read)
    return read_other if has_text or row.place else _unless_another(read_other, at, keep=keep)


def _unless_another(read: ReadChild, at: str, *, keep: bool) -> ReadChild:
    """Wrap a reader: an element with text that only shares its name with another version's is unknown."""

    def read_or_keep(child: XmlElement, node: Data, context: Context, place: int) -> None:
        if len(child) or is_blank(child.text or ""):
            read(child, node, context, place)
            return
        messages.unknown_element(context, child, ())
        if keep:
            keep_element(child, node, at, context)

    return read_or_keep


def _after(say: Callable[[Context, XmlElement], None], read: ReadChild) -> ReadChild:
    """Wrap a reader: report something about the child before it is read."""

    def read_after(child: XmlElement, node: Data, context: Context, place: int) -> None:
        say(context, child)
        read(child, node, context, place)

    return read_after


def _aside(read: ReadChild) -> ReadChild:
    """Wrap a reader for an element outside of the robot's description, whose faults are warnings."""

    def read_aside(child: XmlElement, node: Data, context: Context, place: int) -> None:
        before, context.aside = context.aside, True
        read(child, node, context, place)
        context.aside = before

    return read_aside


_INSTANCE = "{http://www.w3.org/2001/XMLSchema-instance}"
# Left in, an `xsi:type` would let a file choose the type that it is validated by.
_OF_SCHEMAS = frozenset({_INSTANCE + "type", _INSTANCE + "nil"})
"""Foreign attributes that make an XSD engine check an element in another way."""

Read = TypeVar("Read")


class RowReaders(dict[str, Read]):
    """Functions that read attributes or children by name, made from rows on demand; `other` reads unknown names."""

    def __init__(self, rows: Mapping[str, Fact], make: Callable[[Fact], Read], other: Read) -> None:
        super().__init__()
        self.rows, self._make, self._other = rows, make, other

    def __missing__(self, name: str) -> Read:
        row = self.rows.get(name)
        if row is None:
            return self._other  # not remembered: hostile files have any number of names
        made = self[name] = self._make(row)
        return made


class ElementReader:
    """Reads the inside of an element into the values of a node of the class `into`; without a class it only checks.

    `at` is the path from the node's own element to this one; it is empty for the node's own.
    """

    def __init__(
        self,
        fact: Fact,
        types: Types,
        version: Version,
        read_child: Callable[[Fact], ReadChild],
        into: type[Node] | None,
        at: str,
    ) -> None:
        self._at, self._keep = at, (keep := into is not None)
        self._required = words = required_words(into) if into is not None and not at else dict[str, tuple[str, ...]]()
        self._attributes = RowReaders(
            {name[1:]: row for name, row in rows_by_name(fact.attributes, version).items()},
            lambda row: attribute_reader(row, types, version, at, words.get(row.place or "", ()), keep=keep),
            self._other_attribute,
        )
        self._children = RowReaders(rows_by_name(fact.children, version), read_child, self._other_child)
        self._plain_attributes = plain_values(fact.attributes, types, version) if keep else {}
        self._plain_children = plain_values(fact.children, types, version) if keep else {}
        self._once = frozenset(row.name for row in self._children.rows.values() if not (row.repeats or row.last))
        self._kinds = frozenset(row.name for row in fact.children if row.kind)
        self._free, self._content = fact.any, fact.place if fact.any and keep else None
        self._read_text = text_reader(fact, types, keep=keep) if fact.type else None
        present = sorted((row for row in fact.rows if row.exists_in(version)), key=lambda row: row.name)
        self._needed = [row.name for row in present if not row.is_attribute and row.required]
        asked = [row for row in present if row.is_attribute and (row.required or row.expected)]
        self._asked = [(row.place if keep and not at else None, row.name[1:], row) for row in asked]
        asked_fields = {field for field, _, _ in self._asked}
        if unasked := [field for field in words if field not in asked_fields]:
            raise ValueError(f"{fact.name}: nothing asks for {', '.join(unasked)}, which its node needs")

    def read(self, element: XmlElement, node: Data, context: Context, place: int) -> None:
        """Read the attributes of an element, then its text and its children, into the values of a node."""
        attributes, plain = self._attributes, self._plain_attributes
        for name, text in element.items():
            if name in plain:  # `store_plain`, without a call for each attribute
                field, parse, is_usual = plain[name]
                try:
                    value = parse(text)
                    if is_usual is None or is_usual(value):
                        node[field] = value
                        continue
                except NOT_PLAIN:
                    pass
            attributes[name](element, name, text, node, context)
        for field, name, row in self._asked:
            if field not in node and element.get(name) is None:
                self._missing(element, field, row, node, context)
        if self._read_text is not None:
            self._read_text(element, node, context)
        elif (self._free or not context.simple) and (stray := element.text) and stray.strip(BLANKS):
            self._stray(element, stray, node, context)
        if len(element) or self._needed:
            self._read_children(element, node, context)

    def _missing(self, element: XmlElement, field: str | None, row: Fact, node: Data, context: Context) -> None:
        """Report an attribute that is not there, and fill its field if there is no node without it."""
        messages.missing_attribute(context, element, row)
        if field is not None and field in self._required:
            stand_in(node, field, self._required[field], context)

    def _other_attribute(self, element: XmlElement, name: str, text: str, node: Data, context: Context) -> None:
        """Read an attribute that the table does not have."""
        if name[0] == "{":
            messages.prefixed_attribute(context, element, name)
        is_prefixed = name[0] == "{" and not messages.knows_no_prefixes(context, element)
        if name in _OF_SCHEMAS or not (is_prefixed or self._free):
            messages.unknown_attribute(context, element, name, self._attributes.rows, self._children.rows)
        if self._keep:
            keep_attribute(element, node, self._at, context, (name, text))

    def _stray(
        self, element: XmlElement, text: str, node: Data, context: Context, after: XmlElement | None = None
    ) -> None:
        """Report and keep text between elements."""
        if not self._free:
            messages.stray_text(context, element, text, after)
        if self._keep:
            keep_text(element, node, self._at, context, text)

    def _read_children(self, element: XmlElement, node: Data, context: Context) -> None:
        """Read all children, and report those that should be there."""
        counts: dict[str, int] = {}
        children, once = self._children, self._once
        # an element that may have more than text in it is read by the function of its row
        plain = self._plain_children if context.simple else {}
        may_have_stray_text = not context.simple and self._content is None
        for child in element:
            tag: str = child.tag  # pyright: ignore[reportAssignmentType] - the parser removes comments
            place = counts[tag] = counts.get(tag, 0) + 1
            if place > 1 and tag in once:
                self._repeated(child, node, context)
            elif tag not in plain or not store_plain(plain[tag], child.text, node):
                children[tag](child, node, context, place)
            if may_have_stray_text and (stray := child.tail) and stray.strip(BLANKS):
                self._stray(element, stray, node, context, after=child)
        if self._needed or (self._kinds and len(counts) > 1):
            self._check_children(element, counts, context)

    def _repeated(self, child: XmlElement, node: Data, context: Context) -> None:
        messages.repeated(context, child)
        if self._keep:
            keep_element(child, node, self._at, context)

    def _check_children(self, element: XmlElement, counts: Mapping[str, int], context: Context) -> None:
        """Report children of several kinds where there may be one, and those that should be there."""
        if self._kinds:
            found = [child for child in element if child.tag in self._kinds]
            for child in found:
                if child.tag != found[0].tag:
                    messages.repeated(context, child)
        for name in self._needed:
            if name not in counts and not context.partial:
                messages.missing_child(context, element, name)

    def _other_child(self, child: XmlElement, node: Data, context: Context, place: int) -> None:
        """Read a child that the table does not have."""
        if self._content is not None:
            keep_content(child, node, self._content, context)
            return
        is_plain = str(child.tag)[0] != "{" or messages.knows_no_prefixes(context, child)
        if not self._free and (self._read_text is not None or is_plain):
            messages.unknown_element(context, child, self._children.rows, self._attributes.rows, self._once)
        elif not self._free:
            messages.prefixed_element(context, child)
        if self._keep:
            keep_element(child, node, self._at, context)


NOT_PLAIN = (ValueError, KeyError, TypeError, AttributeError)
"""What a parser raises; the last two where there is no text."""
_USUAL_BOOLS = {"true": True, "false": False}
"""Of the others, the node remembers the spelling."""


class PlainValue(NamedTuple):
    """How to recognize the plain values of a row, which need no finding.

    `parse` raises one of `NOT_PLAIN` for other texts; where `is_usual` is there, a value is plain if that says so.
    """

    field: str
    parse: Callable[[Any], Any]
    is_usual: Callable[[Any], bool] | None


def plain_values(rows: Iterable[Fact], types: Types, version: Version) -> dict[str, PlainValue]:
    """Return, by name, the rows that hold nothing but a value and need no finding themselves."""
    return {
        row.name.removeprefix("@"): PlainValue(field, _parser(row, types), _usual_values(row))
        for row in rows
        if row.exists_in(version) and not (row.dialect or row.deprecated or row.aside or row.rows)
        if row.type not in {None, "pose"} and (field := own_field(row))
    }


def store_plain(plain: PlainValue, text: str | None, node: Data) -> bool:
    """Store the value of a text if it is plain; returns whether it was."""
    field, parse, is_usual = plain
    try:
        value = parse(text)
    except NOT_PLAIN:
        return False
    if is_usual is not None and not is_usual(value):
        return False
    node[field] = value
    return True


def _parser(row: Fact, types: Types) -> Callable[[Any], Any]:
    if row.type == "string":
        return str if row.is_attribute else stripped
    return _USUAL_BOOLS.__getitem__ if row.type == "bool" else types[str(row.type)].parse


def _usual_values(row: Fact) -> Callable[[Any], bool] | None:
    """Return a check that nothing is wrong with a value; None if nothing can be."""
    if row.enum:
        return frozenset(row.enum).__contains__
    if row.bounds is None:
        return bool if row.type == "string" and not row.is_attribute else None  # blank text may need a finding
    low, high = row.bounds
    if row.type in SCALARS:
        return lambda value: low <= value <= high
    return lambda value: low <= min(value) and max(value) <= high
