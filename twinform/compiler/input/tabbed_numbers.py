"""Numbers with tabs or new lines between them, which are blanks to XML and none to urdfdom."""

import re

from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import structure

_LINES = bytes.maketrans(b"\t\r", b"\n\n")
_ASIDE = re.compile(rb"<!--.*?-->|<\?.*?\?>|<!\[CDATA\[.*?\]\]>", re.DOTALL)
_ATTRIBUTE = re.compile(rb"""([\w:.-]+)\s*=\s*(?:"([^"<]*)"|'([^'<]*)')""")
_REFERENCE = re.compile(rb"&#(?:0*(?:9|10|13)|x0*[9aAdD]);")
_NUMBERS = re.compile(rb"[-+.\deE \t\r\n]+")
_DIGIT = re.compile(rb"\d")
_BREAK = re.compile(rb"[\t\r\n]")


def report_tabbed_numbers(text: bytes, sink: DiagnosticSink) -> None:
    """Report the attributes of a URDF file that have some; an XML parser makes blanks of them."""
    if not _may_have_some(text):
        return
    bare = _ASIDE.sub(_lines_alone, text)
    line, counted = 1, 0
    for found in _ATTRIBUTE.finditer(bare):
        value = _REFERENCE.sub(b"\t", found[2] or found[3] or b"")
        if _BREAK.search(value) and _DIGIT.search(value) and _NUMBERS.fullmatch(value):
            name = found[1].decode()
            message = f"the numbers of {name!r} have a tab or a new line between them; expected blanks"
            line, counted = line + bare.count(b"\n", counted, found.start()), found.start()
            sink.report(structure.TABBED_NUMBERS, message, Location(sink.file, line), expected="blanks")


def _may_have_some(text: bytes) -> bool:
    """Whether a tab or a new line follows a digit, which in most files is never so: quicker than to look for it."""
    return b"&#" in text or any(piece.rstrip(b" ")[-1:].isdigit() for piece in text.translate(_LINES).split(b"\n"))


def _lines_alone(found: re.Match[bytes]) -> bytes:
    return b"\n" * found[0].count(b"\n")
