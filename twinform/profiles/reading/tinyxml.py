"""TinyXML and TinyXML-2, the parsers of URDF in C++: what they take that XML is not, and what of XML they refuse.

Neither knows namespaces, entities of a DTD or the normalization of blanks, and both go on after `--` in a comment or a
bare `&`. TinyXML stops at the first text outside of the root without a word; TinyXML-2 takes a declaration only before
everything else, and takes every `<?...?>` for one.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from twinform.profiles.reading.nodes import RawNode, UnparsedError

_NAME = r"[A-Za-z_:\x80-\U0010ffff][\w.:\x80-\U0010ffff-]*"
_TAG = re.compile(rf"<({_NAME})")
_TAG_2 = re.compile(r"<([A-Za-z_:\x80-\U0010ffff][\w.:\x80-\U0010ffff-]*)")
_ATTRIBUTE = re.compile(rf"""\s*({_NAME})\s*=\s*(?:"([^"]*)"|'([^']*)')""")
_UNQUOTED = re.compile(rf"""\s*({_NAME})\s*=\s*([^\s"'/>]+)""")
_END = re.compile(rf"</({_NAME})\s*>")
_CLOSE = re.compile(r"\s*(/?)>")
_REFERENCE = re.compile(r"&(?:#x([0-9A-Fa-f]+)|#(\d+)|(lt|gt|amp|quot|apos));")
_NAMED = {"lt": "<", "gt": ">", "amp": "&", "quot": '"', "apos": "'"}
_ASIDE = (("<!--", "-->"), ("<![CDATA[", "]]>"))
_LARGEST = 0x10FFFF
_LONGEST_LINE = 8191
_CUT = re.compile(rb"[\r\0]")


@dataclass(frozen=True, slots=True)
class Dialect:
    """What one of the two does."""

    unquoted: bool
    """Whether the value of an attribute may stand without quotes."""
    late_declarations: bool
    """Whether `<?...?>` may stand anywhere."""
    stops_at_text: bool
    """Whether text outside of the root ends the reading without an error."""


TINYXML = Dialect(unquoted=True, late_declarations=True, stops_at_text=True)
TINYXML_2 = Dialect(unquoted=False, late_declarations=False, stops_at_text=False)


def parse(content: bytes, dialect: Dialect) -> list[RawNode]:
    """The elements at the top of a text.

    Raises:
        UnparsedError: the parser refuses it.
    """
    # Both parsers are handed a C string, which ends at the first zero byte.
    text = content.split(b"\0")[0].decode("utf-8-sig", "replace").replace("\r\n", "\n").replace("\r", "\n")
    return _Parser(text, dialect).document()


def in_lines(content: bytes) -> bytes:
    """The text as Bullet hands it to TinyXML-2: in lines of 8191 bytes at most, each cut at an odd end of line."""
    lines = content.split(b"\n")
    pieces = (line[at : at + _LONGEST_LINE] for line in lines for at in range(0, max(len(line), 1), _LONGEST_LINE))
    return b"\n".join(_CUT.split(piece, maxsplit=1)[0] for piece in pieces)


class _Parser:
    """A place in a text, and the elements that are open there."""

    def __init__(self, text: str, dialect: Dialect) -> None:
        self.text, self.dialect = text, dialect
        self.at, self.line, self.counted = 0, 1, 0
        self.top: list[RawNode] = []
        self.open: list[RawNode] = []
        self.begun = False
        """Whether anything but declarations was there."""

    def document(self) -> list[RawNode]:
        while self.at < len(self.text) and self._node():
            pass
        if self.open:
            raise self._error(f"<{self.open[-1].tag}> has no end tag")
        if not self.top:
            raise self._error("there is no element")
        return self.top

    def _node(self) -> bool:
        """Read the next thing; False where the reading ends."""
        start = self.text.find("<", self.at)
        words = self.text[self.at : start if start >= 0 else len(self.text)]
        if words.strip():
            if not self.open and (self.dialect.stops_at_text or start < 0):
                if self.dialect.stops_at_text:
                    return False
                raise self._error("there is text after the last element")
            self.begun = True
            if self.open:
                self.open[-1].text += _decoded(words)
        if start < 0:
            self.at = len(self.text)
            return False
        self.at = start
        if self._passed_over():
            return True
        if self.text.startswith("</", start):
            self._end_tag()
        else:
            self._start_tag()
        self.begun = True
        return True

    def _passed_over(self) -> bool:
        for begin, end in _ASIDE:
            if self.text.startswith(begin, self.at):
                if self.open and not self.open[-1].children and not self.open[-1].text.strip():
                    self.open[-1].begins_with_comment |= begin == "<!--"
                self._jump(end, begin)
                self.begun = True
                return True
        if self.text.startswith("<?", self.at):
            if not self.dialect.late_declarations and (self.open or self.begun):
                raise self._error("<?...?> stands after something else")
            self._jump("?>" if not self.dialect.late_declarations else ">", "<?")
            return True
        if self.text.startswith("<!", self.at):
            self._jump(">", "<!")
            self.begun = True
            return True
        return False

    def _jump(self, end: str, begin: str) -> None:
        found = self.text.find(end, self.at + len(begin))
        if found < 0:
            raise self._error(f"{begin} has no end")
        self.at = found + len(end)

    def _end_tag(self) -> None:
        found = _END.match(self.text, self.at)
        if found is None or not self.open or found[1] != self.open[-1].tag:
            raise self._error(f"an end tag that does not fit: {self.text[self.at : self.at + 40].split('>')[0]}>")
        self.open.pop()
        self.at = found.end()

    def _start_tag(self) -> None:
        found = _TAG.match(self.text, self.at)
        if found is None:
            raise self._error(f"no name follows '<': {self.text[self.at : self.at + 20]!r}")
        node = RawNode(found[1], self._line())
        self.at = found.end()
        while (closed := _CLOSE.match(self.text, self.at)) is None:
            name, value = self._attribute(node)
            if name in node.attributes:
                raise self._error(f"<{node.tag}> has the attribute {name!r} twice")
            node.attributes[name] = _decoded(value)
        self.at = closed.end()
        (self.open[-1].children if self.open else self.top).append(node)
        if not closed[1]:
            self.open.append(node)

    def _attribute(self, node: RawNode) -> tuple[str, str]:
        found = _ATTRIBUTE.match(self.text, self.at)
        if found is not None:
            self.at = found.end()
            return found[1], found[2] if found[2] is not None else found[3]
        bare = _UNQUOTED.match(self.text, self.at) if self.dialect.unquoted else None
        if bare is None:
            raise self._error(f"the attributes of <{node.tag}> cannot be read")
        self.at = bare.end()
        return bare[1], bare[2]

    def _line(self) -> int:
        self.line += self.text.count("\n", self.counted, self.at)
        self.counted = self.at
        return self.line

    def _error(self, message: str) -> UnparsedError:
        return UnparsedError(message, self._line())


def _decoded(value: str) -> str:
    return _REFERENCE.sub(_character, value) if "&" in value else value


def _character(found: re.Match[str]) -> str:
    if found[3]:
        return _NAMED[found[3]]
    number = int(found[1], 16) if found[1] else int(found[2])
    return chr(number) if number <= _LARGEST else found[0]


def walk(nodes: list[RawNode]) -> Iterator[RawNode]:
    """All elements, in the order of the text."""
    for node in nodes:
        yield node
        yield from walk(node.children)
