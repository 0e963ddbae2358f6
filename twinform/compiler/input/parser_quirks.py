"""Values that are fine in XML and that a parser reads otherwise.

urdfdom does not separate numbers at tabs and new lines; libsdformat reads a text only up to the first comment in it.
"""

import re

from lxml import etree

from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.schemas import XmlElement, path_of
from twinform.schemas.xml import Places
from twinform.text.tokens import COMMENT, INSTRUCTION, SECTION

_KINDS = bytes.maketrans(b"\t\r123456789", b"\n\n000000000")
"""One digit and one break stand for all."""
_ASIDE = re.compile(f"{COMMENT}|{INSTRUCTION}|{SECTION}".encode())
_ATTRIBUTE = re.compile(rb"""(?<![\w:.-])([\w:.-]++)\s*+=\s*+(?:"([^"<]*+)"|'([^'<]*+)')""")
_TABBED = re.compile(rb"""["'][-+.\deE ]*+(?:[\t\r\n]|&#)[-+.\deE \t\r\n&#xaAdD;]*+["']""")
"""Numbers with a break between them, or a reference, in quotes: hardly any file has such, and it is quick to see."""
_REFERENCE = re.compile(rb"&#(?:0*(?:9|10|13)|x0*[9aAdD]);")
_NUMBERS = re.compile(rb"[-+.\deE \t\r\n]+")
_DIGIT = re.compile(rb"\d")
_BREAK = re.compile(rb"[\t\r\n]")
_COMMENT = b"<!--"
_BEFORE_COMMENT = 200
"""So many bytes before a comment are searched for text."""


def report_tabbed_numbers(text: bytes, sink: DiagnosticSink) -> None:
    """Report numbers of a URDF file with tabs or new lines between them, of which an XML parser makes blanks."""
    if not _has_break_after_digit(text):
        return
    bare = _ASIDE.sub(_lines_alone, text)
    if not _TABBED.search(bare):
        return
    line, counted = 1, 0
    for found in _ATTRIBUTE.finditer(bare):
        value = _REFERENCE.sub(b"\t", found[2] or found[3] or b"")
        if _BREAK.search(value) and _DIGIT.search(value) and _NUMBERS.fullmatch(value):
            name = found[1].decode()
            message = f"the numbers of {name!r} have a tab or a new line between them; expected blanks"
            line, counted = line + bare.count(b"\n", counted, found.start()), found.start()
            sink.report(rules.TABBED_NUMBERS, message, Location(sink.file, line), expected="blanks")


def _has_break_after_digit(text: bytes) -> bool:
    """Whether a tab or a new line follows a digit, which in most files is never so: quicker than to look for it."""
    return b"&#" in text or b"0\n" in text.translate(_KINDS, b" ")


def _lines_alone(found: re.Match[bytes]) -> bytes:
    return b"\n" * found[0].count(b"\n")


def report_split_values(root: XmlElement, sink: DiagnosticSink) -> None:
    """Report the texts of a tree, with its comments, that have a comment in the middle."""
    places: Places = {}
    for element in root.iter(etree.Element):
        if _is_split(element):
            message = f"the text of <{element.tag}> has a comment in the middle"
            where = Location(sink.file, element.sourceline or 0, path_of(element, places))
            sink.report(rules.SPLIT_VALUE, message, where, found=(element.text or "").strip())


def has_comment_after_text(text: bytes) -> bool:
    """Whether a comment follows text: few files have one that does, and no other is read twice."""
    at = text.find(_COMMENT)
    while at >= 0:
        if text[max(0, at - _BEFORE_COMMENT) : at].rstrip()[-1:] not in b">":
            return True
        at = text.find(_COMMENT, at + 1)
    return False


def _is_split(element: XmlElement) -> bool:
    pieces = [element.text, *(child.tail for child in element)]
    comments_only = len(element) and all(child.tag is etree.Comment for child in element)
    return bool(comments_only and (element.text or "").strip() and any((piece or "").strip() for piece in pieces[1:]))
