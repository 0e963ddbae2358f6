"""Elements, attributes and texts that have no typed field: kept as they were written, with their position."""

from collections.abc import Callable
from typing import Any

from lxml import etree

from twinform.diagnostics import Source
from twinform.ir import Element, Opaque
from twinform.ir.record import filler
from twinform.schemas.messages import Context
from twinform.schemas.node_makers import Data
from twinform.schemas.xml import XmlElement

locate: Callable[[type[Source], tuple[object, ...]], Source] = tuple.__new__  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] - typeshed leaves the items open
"""Makes a Source without the detour through its own constructor: the reader makes one for every node."""
_make_element = filler(Element)
_make_opaque = filler(Opaque)

LAST_LINE = 65535
"""libxml2 keeps no number beyond it."""


def element_xml(element: Any, parent: XmlElement | None = None) -> XmlElement:
    """The XML of an IR `Element`, below `parent` where one is given."""
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
    """The subtree, with sources below the one that is given; one that is `kept` has no text behind it."""
    tag = str(element.tag)
    if above is not None:
        above = locate(Source, (file, element.sourceline or 0, above, tag, element.get("name")))
    attributes = tuple(element.items())
    text = (element.text or "").strip() or None
    children = tuple([read_element(child, file, above) for child in element]) if len(element) else ()
    tail = None if kept else (element.tail or "").strip() or None
    return _make_element((above, tag, attributes, text, children, tail))


def keep_content(child: XmlElement, node: Data, field: str, context: Context) -> None:
    """Keep a child in a field for free content, where it knows where it was written."""
    node.setdefault(field, []).append(read_element(child, context.file, node["source"]))


def keep_element(child: XmlElement, node: Data, at: str, context: Context) -> None:
    """Keep a child with all that is in it; `at` is the path from the node to the element around it."""
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
