"""How consumers read URDF: each with its own XML parser, and by a table of what it reads where.

A loader reads the text and not our tree, and what it makes of a number or of a missing element is its own. So a text is
parsed here as the consumer does it (`tinyxml.py`, `python_xml.py`), and held against the table of the consumer
(`data/reads/`, explained in `notation.py`).
"""

import re
from collections.abc import Iterator

from twinform.profiles.reading.nodes import RawNode, UnparsedError
from twinform.profiles.reading.python_xml import parse_with_expat, parse_with_lxml
from twinform.profiles.reading.reads_notation import reads
from twinform.profiles.reading.tinyxml import TINYXML, TINYXML_2, in_lines, parse
from twinform.profiles.reading.walking import IsThere, Shortfall, shortfalls

__all__ = ["Shortfall", "read_as"]

_ROBOTS = frozenset({"tinyxml", "tinyxml2", "bullet", "sax"})
"""Parsers after which the first robot at the top counts, and not whatever is there."""
_DECLARATIONS = re.compile(rb"^[^\S\n]*<\?xml[^\n]*\?>[^\S\n]*$", re.MULTILINE)
"""Lines that are left out before the text is parsed."""
_NOT_XML = "its XML parser does not read the file"
_LEFT_OUT = "it leaves the element out"
_RECOVERED = "it reads as much of the file as it can"


def read_as(consumer: str, content: bytes, is_there: IsThere = lambda _: True) -> Iterator[Shortfall]:
    """What a consumer cannot read of a text, or needs and does not find in it."""
    table = reads(consumer)
    try:
        top, message = _parsed(table.parser, content)
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


def _parsed(parser: str, content: bytes) -> tuple[list[RawNode], str]:
    if parser == "expat":
        return parse_with_expat(content), ""
    if parser == "sax":
        return parse_with_expat(_DECLARATIONS.sub(b"", content)), ""
    if parser == "lxml":
        return parse_with_lxml(content)
    if parser == "bullet":
        return parse(in_lines(content), TINYXML_2), ""
    return parse(content, TINYXML if parser == "tinyxml" else TINYXML_2), ""
