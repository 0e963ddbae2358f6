"""Makes nodes of the IR from the values that were read for them."""

from collections.abc import Callable, Mapping
from dataclasses import MISSING
from typing import Any, Literal, get_args, get_origin

from lxml import etree

from twinform.diagnostics import Source
from twinform.ir import Element, Node, Opaque
from twinform.ir.record import fields_of, filler, maker
from twinform.ir.tree_walks import classes_in
from twinform.schemas.messages import Context
from twinform.schemas.xml import XmlElement

Data = dict[str, Any]
"""The values of a node by their fields, while it is read."""

_FORMAT = "format"
"""The one required field that no element gives: whoever reads a document knows it."""


class NodeMaker:
    """Makes nodes of one class.

    `inner` are the classes of nodes that no element of their own makes, by their fields. `gathers` is whether values
    have to be completed before a node is made, even where nothing of it is opaque.
    """

    def __init__(self, kind: type[Node], inner: Mapping[str, type[Node]]) -> None:
        self._tuples = [name for name, each in fields_of(kind).items() if each.default == ()]
        self._inner = [(name, NodeMaker(each, {})) for name, each in inner.items()]
        self.gathers = len(self._tuples) > 1 or bool(inner)
        self.make = maker(kind)

    def complete(self, data: Data) -> None:
        """Turn gathered lists into tuples and gathered dicts into nodes."""
        for name in self._tuples:
            if name in data:
                data[name] = tuple(data[name])
        for name, inner in self._inner:
            if name in data:
                inner.complete(data[name])
                data[name] = inner.make(data[name])


def required_words(kind: type[Node]) -> Mapping[str, tuple[str, ...]]:
    """Return the required fields of a class, with the allowed words of those that take only some."""
    return {
        name: get_args(each.type) if get_origin(each.type) is Literal else ()
        for name, each in fields_of(kind).items()
        if each.default is MISSING and name != _FORMAT
    }


def node_class(holder: type[Node], field: str, kind: str | None = None) -> type[Node]:
    """Return the class of the nodes in a field; of several, the one of a kind.

    Raises:
        ValueError: there is no such field, or it does not hold nodes of one class.
    """
    require_place(holder, field)
    found = [each for each in classes_in(holder, field) if kind in {None, _kind(each)}]
    if len(found) != 1:
        raise ValueError(f"{holder.__name__}.{field} does not hold nodes of one class")
    return found[0]


def require_place(holder: type[Node], place: str) -> None:
    """Check that the place of a row is a field of the class that the row fills, or of a node inside it.

    Raises:
        ValueError: it is not.
    """
    steps = place.removeprefix("/").split(".")
    for step in filter(None, steps):
        if step not in fields_of(holder):
            raise ValueError(f"{holder.__name__} has no field {step!r}")
        if step != steps[-1]:
            (holder,) = classes_in(holder, step)


def _kind(node: type[Node]) -> object:
    return fields_of(node)["kind"].default if "kind" in fields_of(node) else None


locate: Callable[[type[Source], tuple[object, ...]], Source] = tuple.__new__  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] - typeshed leaves the items open
"""Makes a Source without the detour through its own constructor: the reader makes one for every node."""
_make_element = filler(Element)
_make_opaque = filler(Opaque)

LAST_LINE = 65535
"""libxml2 keeps no number beyond it."""


def element_xml(element: Any, parent: XmlElement | None = None) -> XmlElement:
    """Return the XML of an IR `Element`, below `parent` if one is given."""
    attributes = dict(element.attributes)
    if parent is None:
        made = etree.Element(element.name, attributes)
    else:
        made = etree.SubElement(parent, element.name, attributes)
    made.text, made.tail = element.text, element.tail
    if element.source is not None:
        made.sourceline = min(element.source.line, LAST_LINE)  # pyright: ignore[reportAttributeAccessIssue] - it can be set
    for child in element.children:
        element_xml(child, made)
    return made


def read_element(element: XmlElement, file: str, above: Source | None, *, kept: bool = False) -> Element:
    """Read a subtree as an `Element`, with sources below the given one; a `kept` one has no text behind it."""
    tag = str(element.tag)
    if above is not None:
        above = locate(Source, (file, element.sourceline or 0, above, tag, element.get("name")))
    attributes = tuple(element.items())
    text = (element.text or "").strip() or None
    children = tuple([read_element(child, file, above) for child in element]) if len(element) else ()
    tail = None if kept else (element.tail or "").strip() or None
    return _make_element((above, tag, attributes, text, children, tail))


def keep_content(child: XmlElement, node: Data, field: str, context: Context) -> None:
    """Keep a child in a field for free content, which knows where it was written."""
    node.setdefault(field, []).append(read_element(child, context.file, node["source"]))


def keep_element(child: XmlElement, node: Data, at: str, context: Context) -> None:
    """Keep a child with all inside it; `at` is the path from the node to the element around it."""
    element = read_element(child, context.file, None, kept=True)
    _keep(child, node, context, str(child.tag), (at, element, None, None))


def keep_attribute(element: XmlElement, node: Data, at: str, context: Context, attribute: tuple[str, str]) -> None:
    """Keep an attribute of the element at a path from the node."""
    _keep(element, node, context, f"@{attribute[0]}", (at, None, attribute, None))


def keep_text(element: XmlElement, node: Data, at: str, context: Context, text: str) -> None:
    """Keep text between the children of the element at a path from the node."""
    _keep(element, node, context, "text()", (at, None, None, " ".join(text.split())))


def _keep(element: XmlElement, node: Data, context: Context, called: str, part: tuple[Any, ...]) -> None:
    at = part[0]
    step = f"{at}/{called}" if at else called
    source = locate(Source, (context.file, element.sourceline or 0, node["source"], step, None))
    opaque: list[Opaque] = node.setdefault("opaque", [])
    opaque.append(_make_opaque((source, *part)))
