"""Reads the inside of one element by its facts: every finding there can be, and nothing that is quick."""

from collections.abc import Callable
from typing import TypeVar

from twinform.schemas import messages
from twinform.schemas.facts import Fact, Version, rows_by_name
from twinform.schemas.fast_path import GIVE_UP, quick_parse
from twinform.schemas.messages import Context
from twinform.schemas.row_findings import ReadChild
from twinform.schemas.untyped_parts import keep_content, keep_element, keep_part
from twinform.schemas.value_readers import Types, attribute_reader, text_reader
from twinform.schemas.value_stores import Data
from twinform.schemas.xml import XmlElement, is_blank

_INSTANCE = "{http://www.w3.org/2001/XMLSchema-instance}"
# Left in, an `xsi:type` would let a file choose the type that it is validated by.
_OF_SCHEMAS = frozenset({_INSTANCE + "type", _INSTANCE + "nil"})
"""Foreign attributes that make an XSD engine check an element in another way."""

Closure = TypeVar("Closure")


class Made(dict[str, Closure]):
    """Closures by name, each made when it is first looked up."""

    def __init__(self, make: Callable[[str], Closure]) -> None:
        super().__init__()
        self._make = make

    def __missing__(self, name: str) -> Closure:
        made = self[name] = self._make(name)
        return made


class ElementReader:
    """Reads the inside of an element into the dict of its node; where `keep` is false it only checks.

    Each step is a method, so that generated readers, which read what is usual, call it for what is not.
    """

    def __init__(
        self, fact: Fact, types: Types, version: Version, read_child: Callable[[Fact], ReadChild], *, keep: bool
    ) -> None:
        self.keep = keep
        self.attribute_rows = {name[1:]: row for name, row in rows_by_name(fact.attributes, version).items()}
        self.child_rows = rows_by_name(fact.children, version)
        self._attributes = Made(lambda name: attribute_reader(self.attribute_rows[name], types, version, keep=keep))
        self._children = Made(lambda name: read_child(self.child_rows[name]))
        parses = [(row, quick_parse(row, types, version)) for row in fact.attributes if keep]
        self._quick = {row.name[1:]: (row.place or "", parse) for row, parse in parses if parse}
        present = [row for row in fact.rows if row.exists_in(version)]
        asked = [row for row in present if row.is_attribute and (row.required or row.expected)]
        self._asked = {row.name[1:]: row for row in asked}
        self._needed_attributes = frozenset(self._asked)
        self._needed = frozenset(row.name for row in present if not row.is_attribute and row.required)
        self._once = frozenset(row.name for row in self.child_rows.values() if not row.repeats)
        self._free, self._content = fact.any, fact.place if fact.any and keep else None
        self._read_text = text_reader(fact, types, fact.place, keep=keep) if fact.type else None
        self._kinds = frozenset(row.name for row in fact.children if row.kind)

    def read(self, element: XmlElement, node: Data, at: str, context: Context) -> None:
        """Read all of it; `at` is the path from the node to the element."""
        quick = self._quick
        for name, text in element.items():
            if name in quick:
                field, parse = quick[name]
                try:
                    node[field] = parse(text)
                    continue
                except GIVE_UP:
                    pass
            self.attribute(element, name, text, node, at, context)
        if self._needed_attributes:
            self.missing_attributes(element, context)
        self.text(element, node, at, context)
        if len(element) or self._needed:
            self.children(element, node, at, context)

    def attribute(self, element: XmlElement, name: str, text: str, node: Data, at: str, context: Context) -> None:
        """Read an attribute."""
        if name in self.attribute_rows:
            self._attributes[name](element, text, node, at, context)
            return
        if name[0] == "{":
            messages.prefixed_attribute(context, element, name)
        if name in _OF_SCHEMAS or (name[0] != "{" and not self._free):
            messages.unknown_attribute(context, element, name, self.attribute_rows, self.child_rows)
        if self.keep:
            keep_part(element, node, context, {"at": at, "attribute": (name, text)})

    def missing_attributes(self, element: XmlElement, context: Context) -> None:
        """Report the attributes that should be there."""
        if not self._needed_attributes.issubset(element.keys()):
            for name in sorted(self._needed_attributes.difference(element.keys())):
                messages.missing_attribute(context, element, self._asked[name])

    def text(self, element: XmlElement, node: Data, at: str, context: Context) -> None:
        """Read the text before the first child."""
        if self._read_text is not None:
            self._read_text(element, node, at, context)
        elif not is_blank(text := element.text or ""):
            self.stray(element, text, node, at, context)

    def stray(
        self, element: XmlElement, text: str, node: Data, at: str, context: Context, after: XmlElement | None = None
    ) -> None:
        """Report and keep text between elements."""
        if not self._free:
            messages.stray_text(context, element, text, after)
        if self.keep:
            keep_part(element, node, context, {"at": at, "text": " ".join(text.split())})

    def children(self, element: XmlElement, node: Data, at: str, context: Context) -> None:
        """Read all children, and report those that should be there."""
        counts: dict[str, int] = {}
        for child in element:
            tag: str = child.tag  # pyright: ignore[reportAssignmentType] - the parser removes comments
            place = counts[tag] = counts.get(tag, 0) + 1
            self.child(child, node, at, place, context)
            if not context.clean:
                self.tail(element, child, node, at, context)
        self.missing_children(element, counts, context)

    def child(self, child: XmlElement, node: Data, at: str, place: int, context: Context) -> None:
        """Read a child, which is the one at `place` among its like."""
        tag = str(child.tag)
        if tag not in self.child_rows:
            self._other_child(child, node, at, context)
        elif place > 1 and tag in self._once:
            messages.repeated(context, child)
            if self.keep:
                keep_element(child, node, at, context)
        else:
            self._children[tag](child, node, at, place, context)

    def other_version(self, child: XmlElement, context: Context) -> None:
        """Report a child that only other versions have."""
        messages.outside_version(context, child, self.child_rows[str(child.tag)])

    def tail(self, element: XmlElement, child: XmlElement, node: Data, at: str, context: Context) -> None:
        """Read the text after a child."""
        if self._content is None and not is_blank(tail := child.tail or ""):
            self.stray(element, tail, node, at, context, after=child)

    def missing_children(self, element: XmlElement, counts: dict[str, int], context: Context) -> None:
        """Report children of several kinds where there is one, and those that should be there."""
        if self._kinds and len(self._kinds & counts.keys()) > 1:
            _other_kinds(element, self._kinds, context)
        if not self._needed.issubset(counts):
            for name in sorted(self._needed.difference(counts)):
                messages.missing_child(context, element, name)

    def _other_child(self, child: XmlElement, node: Data, at: str, context: Context) -> None:
        if self._content is not None:
            keep_content(child, node, self._content, context)
            return
        if not self._free and (self._read_text is not None or str(child.tag)[0] != "{"):
            messages.unknown_element(context, child, self.child_rows, self.attribute_rows)
        elif not self._free:
            messages.prefixed_element(context, child)
        if self.keep:
            keep_element(child, node, at, context)


def _other_kinds(element: XmlElement, kinds: frozenset[str], context: Context) -> None:
    """Report the children that are of another kind than the first, where an element has one of several."""
    found = [child for child in element if child.tag in kinds]
    for child in found:
        if child.tag != found[0].tag:
            messages.repeated(context, child)
