"""The XML parsers of consumers: TinyXML and TinyXML-2 imitated, expat and lxml called themselves.

Neither TinyXML nor TinyXML-2 knows namespaces, entities of a DTD or the normalization of blanks, and both continue
after `--` in a comment or a bare `&`. TinyXML silently stops at the first text outside of the root; TinyXML-2 takes a
declaration only before everything else, and takes every `<?...?>` for one.
"""

import io
import re
from xml.parsers import expat

from lxml import etree

from twinform.dataclass import dataclass
from twinform.lazy import lazy_pattern
from twinform.profiles.nodes import RawNode, UnparsedError
from twinform.schemas import XmlElement

_NAME = r"[A-Za-z_:\x80-\U0010ffff][\w.:\x80-\U0010ffff-]*"
_TAG = lazy_pattern(rf"<({_NAME})")
_ATTRIBUTE = lazy_pattern(rf"""\s*({_NAME})\s*=\s*(?:"([^"]*)"|'([^']*)')""")
_UNQUOTED = lazy_pattern(rf"""\s*({_NAME})\s*=\s*([^\s"'/>]+)""")
_END = lazy_pattern(rf"</({_NAME})\s*>")
_CLOSE = lazy_pattern(r"\s*(/?)>")
_REFERENCE = lazy_pattern(r"&(?:#x([0-9A-Fa-f]+)|#(\d+)|(lt|gt|amp|quot|apos));")
_NAMED = {"lt": "<", "gt": ">", "amp": "&", "quot": '"', "apos": "'"}
_ASIDE = (("<!--", "-->"), ("<![CDATA[", "]]>"))
_LARGEST = 0x10FFFF
_LONGEST_LINE = 8191
_CUT = lazy_pattern(rb"[\r\0]")


@dataclass(frozen=True, slots=True)
class Dialect:
    """The differences between TinyXML and TinyXML-2."""

    unquoted: bool
    """Whether the value of an attribute needs no quotes."""
    late_declarations: bool
    """Whether `<?...?>` may stand anywhere."""
    stops_at_text: bool
    """Whether text outside of the root silently ends the document."""


TINYXML = Dialect(unquoted=True, late_declarations=True, stops_at_text=True)
TINYXML_2 = Dialect(unquoted=False, late_declarations=False, stops_at_text=False)


def parse_with_tinyxml(content: bytes, dialect: Dialect) -> list[RawNode]:
    """The elements at the top of a text, as TinyXML or TinyXML-2 reads it.

    Raises:
        UnparsedError: the parser refuses it.
    """
    # Both parsers are handed a C string, which ends at the first zero byte.
    text = content.split(b"\0")[0].decode("utf-8-sig", "replace").replace("\r\n", "\n").replace("\r", "\n")
    return _Parser(text, dialect).read_document()


def split_as_bullet(content: bytes) -> bytes:
    """The text as Bullet passes it to TinyXML-2: in lines of 8191 bytes at most, each cut at an odd end of line."""
    lines = content.split(b"\n")
    pieces = (line[at : at + _LONGEST_LINE] for line in lines for at in range(0, max(len(line), 1), _LONGEST_LINE))
    return b"\n".join(_CUT.split(piece, maxsplit=1)[0] for piece in pieces)


class _Parser:
    """A position in a text, and the elements that are open there."""

    def __init__(self, text: str, dialect: Dialect) -> None:
        self.text, self.dialect = text, dialect
        self.at, self.line, self.counted = 0, 1, 0
        self.top: list[RawNode] = []
        self.open: list[RawNode] = []
        self.begun = False
        """Whether anything but declarations was read."""

    def read_document(self) -> list[RawNode]:
        while self.at < len(self.text) and self._read_next():
            pass
        if self.open:
            raise self._error(f"<{self.open[-1].tag}> has no end tag")
        if not self.top:
            raise self._error("there is no element")
        return self.top

    def _read_next(self) -> bool:
        """Read the next text and tag; False at the end of the document."""
        start = self.text.find("<", self.at)
        words = self.text[self.at : start if start >= 0 else len(self.text)]
        if words.strip():
            if not self.open and (self.dialect.stops_at_text or start < 0):
                if self.dialect.stops_at_text:
                    return False
                raise self._error("there is text after the last element")
            self.begun = True
            if self.open:
                self.open[-1].text += _decode_references(words)
        if start < 0:
            self.at = len(self.text)
            return False
        self.at = start
        if self._skip_aside():
            return True
        if self.text.startswith("</", start):
            self._read_end_tag()
        else:
            self._read_start_tag()
        self.begun = True
        return True

    def _skip_aside(self) -> bool:
        for begin, end in _ASIDE:
            if self.text.startswith(begin, self.at):
                if self.open and not self.open[-1].children and not self.open[-1].text.strip():
                    self.open[-1].begins_with_comment |= begin == "<!--"
                self._skip_to(end, begin)
                self.begun = True
                return True
        if self.text.startswith("<?", self.at):
            if not self.dialect.late_declarations and (self.open or self.begun):
                raise self._error("<?...?> stands after something else")
            self._skip_to("?>" if not self.dialect.late_declarations else ">", "<?")
            return True
        if self.text.startswith("<!", self.at):
            self._skip_to(">", "<!")
            self.begun = True
            return True
        return False

    def _skip_to(self, end: str, begin: str) -> None:
        found = self.text.find(end, self.at + len(begin))
        if found < 0:
            raise self._error(f"{begin} has no end")
        self.at = found + len(end)

    def _read_end_tag(self) -> None:
        found = _END.match(self.text, self.at)
        if found is None or not self.open or found[1] != self.open[-1].tag:
            raise self._error(f"an end tag that does not fit: {self.text[self.at : self.at + 40].split('>')[0]}>")
        self.open.pop()
        self.at = found.end()

    def _read_start_tag(self) -> None:
        found = _TAG.match(self.text, self.at)
        if found is None:
            raise self._error(f"no name follows '<': {self.text[self.at : self.at + 20]!r}")
        node = RawNode(found[1], self._count_lines())
        self.at = found.end()
        while (closed := _CLOSE.match(self.text, self.at)) is None:
            name, value = self._read_attribute(node)
            if name in node.attributes:
                raise self._error(f"<{node.tag}> has the attribute {name!r} twice")
            node.attributes[name] = _decode_references(value)
        self.at = closed.end()
        (self.open[-1].children if self.open else self.top).append(node)
        if not closed[1]:
            self.open.append(node)

    def _read_attribute(self, node: RawNode) -> tuple[str, str]:
        found = _ATTRIBUTE.match(self.text, self.at)
        if found is not None:
            self.at = found.end()
            return found[1], found[2] if found[2] is not None else found[3]
        bare = _UNQUOTED.match(self.text, self.at) if self.dialect.unquoted else None
        if bare is None:
            raise self._error(f"the attributes of <{node.tag}> cannot be read")
        self.at = bare.end()
        return bare[1], bare[2]

    def _count_lines(self) -> int:
        self.line += self.text.count("\n", self.counted, self.at)
        self.counted = self.at
        return self.line

    def _error(self, message: str) -> UnparsedError:
        return UnparsedError(message, self._count_lines())


def _decode_references(value: str) -> str:
    return _REFERENCE.sub(_decode_reference, value) if "&" in value else value


def _decode_reference(found: re.Match[str]) -> str:
    if found[3]:
        return _NAMED[found[3]]
    number = int(found[1], 16) if found[1] else int(found[2])
    return chr(number) if number <= _LARGEST else found[0]


def parse_with_expat(content: bytes) -> list[RawNode]:
    """The root as `xml.etree.ElementTree` reads it: with namespaces, and only if well-formed.

    Raises:
        UnparsedError: the text is not well-formed.
    """
    parser = expat.ParserCreate(namespace_separator="}")
    top, stack = list[RawNode](), list[RawNode]()

    def start(tag: str, attributes: dict[str, str]) -> None:
        node = RawNode(_with_braces(tag), parser.CurrentLineNumber, {_with_braces(k): v for k, v in attributes.items()})
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
        # the parser refers to itself through this function, a cycle that would only be collected much later
        parser.StartElementHandler = None
    return top


def _with_braces(name: str) -> str:
    return f"{{{name}" if "}" in name else name


def parse_with_lxml(content: bytes) -> tuple[list[RawNode], str]:
    """The root as yourdfpy reads it, and the error after which it recovered; elements with a prefix are then dropped.

    Raises:
        UnparsedError: there is nothing that can be recovered.
    """
    try:
        parser = etree.XMLParser(remove_blank_text=True, resolve_entities=False, no_network=True)
        return [_to_raw_node(etree.fromstring(content, parser))], ""
    except (etree.XMLSyntaxError, ValueError) as error:
        message, line = str(error), getattr(error, "lineno", 0) or 0
    try:
        return [_recover(content)], message
    except (etree.XMLSyntaxError, ValueError, AttributeError, TypeError):
        raise UnparsedError(message, line) from None


def _recover(content: bytes) -> RawNode:
    # before lxml 6.1, iterparse reads the files that entities name unless it is told not to (CVE-2026-41066)
    events = etree.iterparse(
        io.BytesIO(content), recover=True, events=("start", "end"), no_network=True, resolve_entities=False
    )
    for action, element in events:
        if isinstance(element.tag, str) and action == "end" and ":" in element.tag:
            element.getparent().remove(element)  # pyright: ignore[reportOptionalMemberAccess] - the root raises, as there
    if events.root is None:
        raise ValueError("nothing is left")
    return _to_raw_node(events.root)


def _to_raw_node(element: XmlElement) -> RawNode:
    node = RawNode(str(element.tag), element.sourceline or 0, {str(k): str(v) for k, v in element.attrib.items()})
    node.text = element.text or ""
    node.children = [_to_raw_node(child) for child in element if child.tag is not etree.Comment]
    return node
