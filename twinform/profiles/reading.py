"""How consumers read URDF: each with its own XML parser, and by a table of what it reads where.

A loader reads the text and not our tree, and has its own idea of a number or of a missing element. So a text is parsed
here as the consumer parses it (`xml_parsers.py`), and compared with the table of the consumer (`data/reads/`, explained
in `reads_notation.py`).
"""

import re
from collections.abc import Iterator

from twinform.profiles.nodes import RawNode, UnparsedError
from twinform.profiles.reads_notation import reads
from twinform.profiles.walking import IsThere, Shortfall, shortfalls
from twinform.profiles.xml_parsers import (
    TINYXML,
    TINYXML_2,
    parse_with_expat,
    parse_with_lxml,
    parse_with_tinyxml,
    split_as_bullet,
)

__all__ = ["Shortfall", "read_as"]

_ROBOTS = frozenset({"tinyxml", "tinyxml2", "bullet", "sax"})
"""Parsers whose consumers take the first robot at the top; others take whatever element is there."""
_DECLARATIONS = re.compile(rb"^[^\S\n]*<\?xml[^\n]*\?>[^\S\n]*$", re.MULTILINE)
"""Declarations, which are removed before the text is parsed."""
_NOT_XML = "its XML parser does not read the file"
_LEFT_OUT = "it leaves the element out"
_RECOVERED = "it reads as much of the file as it can"


def read_as(consumer: str, content: bytes, is_there: IsThere = lambda _: True) -> Iterator[Shortfall]:
    """What a consumer cannot read in a text, or needs and does not find there."""
    table = reads(consumer)
    try:
        top, message = _parse_as(table.parser, content)
    except UnparsedError as error:
        yield Shortfall("text", "refuses", _NOT_XML, error.message, error.line)
        return
    if message:
        yield Shortfall("text", "misreads", _RECOVERED, message, 0)
    root = next((node for node in top if node.tag == "robot"), None) if table.parser in _ROBOTS else top[0]
    if root is None:
        yield Shortfall("text", "refuses", _NOT_XML, "there is no <robot>", top[0].line)
        return
    for child in [child for child in root.children if table.skips and child.attributes.get(table.skips) == "true"]:
        yield Shortfall("unread", "drops", _LEFT_OUT, f"<{child.tag}> has {table.skips}='true'", child.line, child.tag)
        root.children.remove(child)
    yield from shortfalls(root, table, is_there)


def _parse_as(parser: str, content: bytes) -> tuple[list[RawNode], str]:
    if parser == "expat":
        return parse_with_expat(content), ""
    if parser == "sax":
        return parse_with_expat(_DECLARATIONS.sub(b"", content)), ""
    if parser == "lxml":
        return parse_with_lxml(content)
    if parser == "bullet":
        return parse_with_tinyxml(split_as_bullet(content), TINYXML_2), ""
    return parse_with_tinyxml(content, TINYXML if parser == "tinyxml" else TINYXML_2), ""
