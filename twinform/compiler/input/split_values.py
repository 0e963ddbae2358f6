"""Values with a comment in the middle, which are one text to XML and the first piece of it to libsdformat."""

from lxml import etree

from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import structure
from twinform.schemas import XmlElement, path_of
from twinform.schemas.xml import Places

_BEGIN = b"<!--"
_NEAR = 200
"""So many bytes before a comment are searched for text."""


def report_split_values(text: bytes, sink: DiagnosticSink) -> None:
    """Report them; the tree that everybody else works on has no comments."""
    if not _may_have_some(text):
        return
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, remove_pis=True, recover=True)
    root = etree.fromstring(text, parser)
    places: Places = {}
    for element in root.iter(etree.Element):
        if _is_split(element):
            message = f"the text of <{element.tag}> has a comment in the middle"
            where = Location(sink.file, element.sourceline or 0, path_of(element, places))
            sink.report(structure.SPLIT_VALUE, message, where, found=(element.text or "").strip())


def _may_have_some(text: bytes) -> bool:
    """Whether a comment follows text: few files have one that does, and no other is read twice."""
    at = text.find(_BEGIN)
    while at >= 0:
        if text[max(0, at - _NEAR) : at].rstrip()[-1:] not in b">":
            return True
        at = text.find(_BEGIN, at + 1)
    return False


def _is_split(element: XmlElement) -> bool:
    pieces = [element.text, *(child.tail for child in element)]
    comments_only = len(element) and all(child.tag is etree.Comment for child in element)
    return bool(comments_only and (element.text or "").strip() and any((piece or "").strip() for piece in pieces[1:]))
