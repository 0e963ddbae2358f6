"""Elements, attributes and texts that have no typed field: kept as they were written, with their position."""

from collections.abc import Callable

from twinform.diagnostics import Source
from twinform.schemas.messages import Context
from twinform.schemas.value_stores import Data
from twinform.schemas.xml import XmlElement

locate: Callable[[type[Source], tuple[object, ...]], Source] = tuple.__new__  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] - typeshed leaves the items open
"""Makes a Source without the detour through its own constructor: the readers make one for every node."""


def element_data(element: XmlElement, context: Context, above: Source | None = None) -> Data:
    """The subtree as data for the IR's `Element`, with sources below the one that is given."""
    tag = str(element.tag)
    data: Data = {"name": tag}
    if above is not None:
        line, key = element.sourceline or 0, element.get("name")
        above = data["source"] = locate(Source, (context.file, line, above, tag, key))
    if element.attrib:
        data["attributes"] = tuple(element.items())
    if element.text and not element.text.isspace():
        data["text"] = element.text.strip()
    if element.tail and not element.tail.isspace():
        data["tail"] = element.tail.strip()
    if len(element):
        data["children"] = tuple([element_data(child, context, above) for child in element])
    return data


def keep_part(element: XmlElement, node: Data, context: Context, part: Data) -> None:
    """Keep a part that has no typed field, with where it stood."""
    called = (
        part["element"]["name"]
        if "element" in part
        else f"@{part['attribute'][0]}"
        if "attribute" in part
        else "text()"
    )
    step = f"{part['at']}/{called}" if part["at"] else called
    source = Source(context.file, element.sourceline or 0, node.get("source"), step)
    node.setdefault("opaque", []).append({"source": source, **part})


def keep_element(child: XmlElement, node: Data, at: str, context: Context) -> None:
    """Keep a child with all that is in it."""
    keep_part(child, node, context, {"at": at, "element": element_data(child, context) | {"tail": None}})
