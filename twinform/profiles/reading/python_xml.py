"""The XML parsers of readers in Python, asked themselves: expat behind ElementTree, and lxml that recovers."""

import io
from xml.parsers import expat

from lxml import etree

from twinform.profiles.reading.nodes import RawNode, UnparsedError
from twinform.schemas import XmlElement


def parse_with_expat(content: bytes) -> list[RawNode]:
    """The root as `xml.etree.ElementTree` has it: with namespaces, and nothing that is not well-formed.

    Raises:
        UnparsedError: the text is not well-formed.
    """
    parser = expat.ParserCreate(namespace_separator="}")
    top, stack = list[RawNode](), list[RawNode]()

    def start(tag: str, attributes: dict[str, str]) -> None:
        node = RawNode(_qualified(tag), parser.CurrentLineNumber, {_qualified(k): v for k, v in attributes.items()})
        (stack[-1].children if stack else top).append(node)
        stack.append(node)

    def end(_: str) -> None:
        stack.pop()

    def words(text: str) -> None:
        if stack and not stack[-1].children:
            stack[-1].text += text

    parser.StartElementHandler, parser.EndElementHandler, parser.CharacterDataHandler = start, end, words
    try:
        parser.Parse(content, True)
    except (expat.ExpatError, ValueError, LookupError) as error:
        raise UnparsedError(str(error), parser.CurrentLineNumber) from None
    finally:
        # it refers to itself by this function: Python would look for such a circle only after many more texts
        parser.StartElementHandler = None
    return top


def _qualified(name: str) -> str:
    return f"{{{name}" if "}" in name else name


def parse_with_lxml(content: bytes) -> tuple[list[RawNode], str]:
    """The root as yourdfpy has it, and the error after which it went on; elements with a prefix are gone then.

    Raises:
        UnparsedError: there is nothing that can be recovered.
    """
    try:
        parser = etree.XMLParser(remove_blank_text=True, resolve_entities=False, no_network=True)
        return [_converted(etree.fromstring(content, parser))], ""
    except (etree.XMLSyntaxError, ValueError) as error:
        message, line = str(error), getattr(error, "lineno", 0) or 0
    try:
        return [_recovered(content)], message
    except (etree.XMLSyntaxError, ValueError, AttributeError, TypeError):
        raise UnparsedError(message, line) from None


def _recovered(content: bytes) -> RawNode:
    events = etree.iterparse(io.BytesIO(content), recover=True, events=("start", "end"), no_network=True)
    for action, element in events:
        if isinstance(element.tag, str) and action == "end" and ":" in element.tag:
            element.getparent().remove(element)  # pyright: ignore[reportOptionalMemberAccess] - the root raises, as there
    if events.root is None:
        raise ValueError("nothing is left")
    return _converted(events.root)


def _converted(element: XmlElement) -> RawNode:
    node = RawNode(str(element.tag), element.sourceline or 0, {str(k): str(v) for k, v in element.attrib.items()})
    node.text = element.text or ""
    node.children = [_converted(child) for child in element if child.tag is not etree.Comment]
    return node
