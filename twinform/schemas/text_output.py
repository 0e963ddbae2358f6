"""From the IR to text: what the generated writers of `schemas/generated/` share.

A writer takes a node and returns its element as text, with the line break and the indent before it. It writes what is
usual; where something in a node is odd, `writer.py` writes that node as a tree, and what is odd in the whole document
raises `NeedsTree`.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from typing import Any

from lxml import etree

from twinform.schemas.facts import Version
from twinform.schemas.values import format_numbers, format_value, parse_bool
from twinform.schemas.writer import in_order, is_empty, writer
from twinform.schemas.xml import XmlElement

Write = Callable[[Any, "TextOutput", str], str]
"""Writes a node: (node, output, indent)"""
Item = tuple[Any, Write]
"""A node, and what writes it."""
Arrange = Callable[[Any, list[Item]], list[Item]]
"""Puts the parts of a node in the order in which they have to stand: (node, parts)"""

NEW_LINE = "\n"
"""The indent of the root."""
_STEP = "  "
_ZERO = (0.0, 0.0, 0.0)
_PLAIN_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_.-]*")
_ODD_IN_TEXT = re.compile("[&<>\r]")
_ODD_IN_ATTRIBUTE = re.compile('[&<>"\n\t\r]')
_REFERENCES = {"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "\n": "&#10;", "\t": "&#9;", "\r": "&#13;"}


# Building a tree with lxml, indenting and serializing it takes more than twice as long as putting
# the same text together. A property holds that both write the same bytes.
class NeedsTree(Exception):  # noqa: N818 - it is no error
    """Something that can only be written as a part of the tree of its whole document."""


class _OddPart(Exception):  # noqa: N818 - it is no error
    """A part without a typed field for which the node around it has to be written as a tree."""


def in_text(value: str) -> str:
    """A string as the text of an element."""
    return value if value.isidentifier() or not _ODD_IN_TEXT.search(value) else _ODD_IN_TEXT.sub(_reference, value)


def in_attribute(value: str) -> str:
    """A string as the value of an attribute, between double quotes."""
    if value.isidentifier() or not _ODD_IN_ATTRIBUTE.search(value):
        return value
    return _ODD_IN_ATTRIBUTE.sub(_reference, value)


def _reference(found: re.Match[str]) -> str:
    return _REFERENCES[found[0]]


def bool_text(node: Any, field: str) -> str:
    """A truth value of a node, in its own spelling, as the text of an element."""
    return in_text(_spelling(node, field))


def bool_attribute(node: Any, field: str) -> str:
    """A truth value of a node, in its own spelling, as the value of an attribute."""
    return in_attribute(_spelling(node, field))


def _spelling(node: Any, field: str) -> str:
    spelt, value = node.spelling.get(field) if node.spelling else None, getattr(node, field)
    return spelt if spelt is not None and parse_bool(spelt) == value else format_value(value)


def vector3(values: Sequence[float]) -> str:
    """A vector of three numbers, which nearly all are."""
    x, y, z = values
    return f"{x!r} {y!r} {z!r} ".replace(".0 ", " ")[:-1]


def pose_numbers(pose: Any) -> str | None:
    """The six or seven numbers of a pose; nothing where it has none."""
    xyz, rotation = pose.xyz, pose.quat_xyzw
    if rotation is None:
        rotation = pose.rpy
        if xyz is None and rotation is None:
            return None
    turn = vector3(rotation or _ZERO) if not rotation or len(rotation) == 3 else format_numbers(rotation)
    return f"{vector3(xyz or _ZERO)} {turn}"


def _joined(tag: str, indent: str, attributes: str, body: str, text: str | None, *, keep: bool) -> str:
    if body and text is not None:
        raise _OddPart
    if body:
        return f"{indent}<{tag}{attributes}>{body}{indent}</{tag}>"
    if text is not None:
        return f"{indent}<{tag}{attributes}>{text}</{tag}>"
    return f"{indent}<{tag}{attributes}/>" if attributes or keep else ""


class _Names(dict[str, str]):
    """The names of untyped parts as they are written, by their names in the IR; without those that need a tree."""

    def __init__(self, prefixes: Mapping[str, str], refused: AbstractSet[str]) -> None:
        super().__init__()
        self.prefixes = prefixes
        self.refused = refused

    def __missing__(self, name: str) -> str:
        namespace, _, local = name[1:].partition("}") if name.startswith("{") else ("", "", name)
        if not _PLAIN_NAME.fullmatch(local) or (namespace and namespace not in self.prefixes) or name in self.refused:
            raise NeedsTree
        written = self[name] = f"{self.prefixes[namespace]}:{local}" if namespace else local
        return written


class TextOutput:
    """What the writers know of a document; the arguments are those of `root_text`."""

    def __init__(
        self,
        format: str,
        version: Version,
        namespaces: Mapping[str | None, str],
        root_attributes: str,
        arrange: Arrange | None,
        refused: AbstractSet[str],
    ) -> None:
        if len({*namespaces.values()}) < len(namespaces):
            raise NeedsTree  # of two prefixes lxml takes one
        self.format = format
        self.version = version
        self.root_attributes = root_attributes
        self.arrange = arrange
        self._namespaces = {**namespaces}
        self._holder = etree.tostring(self._new_holder(), encoding="unicode").removesuffix("/>")
        self.declarations = self._holder.removeprefix("<holder")
        self._refused = refused
        self._names = _Names({uri: prefix or "" for prefix, uri in namespaces.items()}, refused)

    def parts(self, node: Any, indent: str, *groups: tuple[Iterable[Any], Write]) -> str:
        """The parts of a node that there may be any number of, in the order of the file."""
        items = [(child, write) for children, write in groups for child in children]
        if len(items) > 1:
            items = in_order(items)
            items = self.arrange(node, items) if self.arrange else items
        texts: list[str] = []
        for child, write in items:  # a comprehension would make the recursion deeper
            texts.append(write(child, self, indent))
        return "".join(texts)

    def with_untyped(
        self,
        node: Any,
        path: str,
        indent: str,
        *,
        attributes: str = "",
        body: str = "",
        text: str | None = None,
        content: Iterable[Any] = (),
        keep: bool = False,
    ) -> str:
        """The element of a node with `content`, and with its parts that have no typed field.

        `path` leads to its facts; `attributes`, `body` and `text` are what of it is written already. An element that
        is empty is nothing unless it is kept.
        """
        parts = node.opaque
        try:
            attributes += self._untyped_attributes(parts, attributes)
            elements = [*content, *(part.element for part in parts if part.element is not None)]
            body += "".join([self._element(element, indent + _STEP) for element in elements])
            return _joined(path.rpartition("/")[2], indent, attributes, body, text, keep=keep)
        except _OddPart:
            return self._as_tree(node, path, indent, keep=keep)

    def _untyped_attributes(self, parts: Iterable[Any], written: str) -> str:
        found: dict[str, str] = {}
        for part in parts:
            if part.at or part.text is not None:
                raise _OddPart
            if part.attribute is not None:
                name, value = part.attribute
                if f' {name}="' in written or name in found:
                    raise _OddPart
                found[name] = f' {self._names[name]}="{in_attribute(value)}"'
        return "".join(found.values())

    def _element(self, element: Any, indent: str) -> str:
        """The text of an untyped element. Text behind it or before its children would change what indents there are."""
        name, text, children = self._names[element.name], element.text, element.children
        if element.tail is not None or (text and children):
            raise _OddPart
        attributes = self._attributes(element.attributes) if element.attributes else ""
        if not children:
            return f"{indent}<{name}{attributes}" + ("/>" if text is None else f">{in_text(text)}</{name}>")
        inner, body = indent + _STEP, ""
        for child in children:
            body += self._element(child, inner)
        return f"{indent}<{name}{attributes}>{body}{indent}</{name}>"

    def _attributes(self, attributes: Iterable[tuple[str, str]]) -> str:
        names = self._names
        return "".join([f' {names[name]}="{in_attribute(value)}"' for name, value in dict(attributes).items()])

    def _as_tree(self, node: Any, path: str, indent: str, *, keep: bool) -> str:
        """The text of a node that `writer.py` has written."""
        if indent == NEW_LINE:
            raise NeedsTree
        holder = self._new_holder()
        made = etree.SubElement(holder, path.rpartition("/")[2])
        writer(self.format, self.version).write(node, made, path)
        if is_empty(made) and not keep:
            return ""
        etree.indent(made, _STEP, level=len(indent) // len(_STEP))
        text = etree.tostring(holder, encoding="unicode").removesuffix("</holder>")[len(self._holder) + 1 :]
        if " xmlns" in text or any(element.tag in self._refused for element in made.iter()):
            raise NeedsTree
        return indent + text

    def _new_holder(self) -> XmlElement:
        return etree.Element("holder", nsmap=self._namespaces)
