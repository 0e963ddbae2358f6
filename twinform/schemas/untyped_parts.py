"""Elements, attributes and texts that have no typed field: kept as they were written, with their position."""

from collections.abc import Callable
from typing import Any

from lxml import etree

from twinform.diagnostics import Source
from twinform.schemas.messages import Context
from twinform.schemas.value_stores import Data
from twinform.schemas.xml import XmlElement

locate: Callable[[type[Source], tuple[object, ...]], Source] = tuple.__new__  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] - typeshed leaves the items open
"""Makes a Source without the detour through its own constructor: the readers make one for every node."""

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


def element_data(element: XmlElement, context: Context, above: Source | None = None) -> Data:
    """The subtree as data for the IR's `Element`, with sources below the one that is given."""
    tag = str(element.tag)
    data: Data = {"name": tag}
    if above is not None:
        line, key = element.sourceline or 0, element.get("name")
        above = data["source"] = locate(Source, (context.file, line, above, tag, key))
    if attributes := element.items():
        data["attributes"] = tuple(attributes)
    text = element.text
    if text and not text.isspace():
        data["text"] = text.strip()
    tail = element.tail
    if tail and not tail.isspace():
        data["tail"] = tail.strip()
    if len(element):
        data["children"] = tuple([element_data(child, context, above) for child in element])
    return data


def keep_content(child: XmlElement, node: Data, field: str, context: Context) -> None:
    """Keep a child in a field for free content, where it knows where it was written."""
    above: Source | None = node.get("source")
    parts = context.parts
    element = parts.element(child, above, kept=False) if parts else element_data(child, context, above)
    node.setdefault(field, []).append(element)


def keep_part(element: XmlElement, node: Data, context: Context, part: Data) -> None:
    """Keep a part that has no typed field, with where it stood."""
    called = f"@{part['attribute'][0]}" if "attribute" in part else "text()"
    _keep(element, node, context, part, called)


def keep_element(child: XmlElement, node: Data, at: str, context: Context) -> None:
    """Keep a child with all that is in it."""
    parts = context.parts
    element = parts.element(child, None, kept=True) if parts else element_data(child, context) | {"tail": None}
    _keep(child, node, context, {"at": at, "element": element}, str(child.tag))


def _keep(element: XmlElement, node: Data, context: Context, part: Data, called: str) -> None:
    at: str = part["at"]
    step = f"{at}/{called}" if at else called
    source = locate(Source, (context.file, element.sourceline or 0, node.get("source"), step, None))
    data = {"source": source, **part}
    opaque: list[Any] = node.setdefault("opaque", [])
    opaque.append(context.parts.opaque(data) if context.parts else data)
