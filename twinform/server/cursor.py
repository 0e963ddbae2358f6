"""The part of a document at the cursor: a tag, the name or the value of an attribute, or a text."""

from enum import Enum, auto

from twinform.dataclass import dataclass
from twinform.diagnostics import Span
from twinform.server.documents import TextDocument
from twinform.server.tolerant_tree import TolerantNode

_BLANKS = " \t\r\n"


class CursorKind(Enum):
    """Which kind of part a cursor is in."""

    TAG = auto()
    """The name of an element in its start tag, which may still be typed."""
    ATTRIBUTE = auto()
    """The name of an attribute, or a place in a start tag where one may begin."""
    VALUE = auto()
    """Between the quotes of an attribute."""
    END_TAG = auto()
    """In an end tag."""
    TEXT = auto()
    """Between tags."""


@dataclass(frozen=True, slots=True)
class Cursor:
    """A place in a document, and the `piece` of text around it.

    `node` is the element whose tag it is in, or the one around a text; None outside of all elements. `attribute` is the
    attribute whose name or value it is in.
    """

    kind: CursorKind
    node: TolerantNode | None
    piece: Span
    attribute: str | None = None


def cursor_at(document: TextDocument, offset: int) -> Cursor | None:
    """Find the part of a document at an offset; None in a comment, CDATA section or processing instruction."""
    tree = document.tree
    if tree.aside_at(offset) is not None:
        return None
    node = tree.at(offset)
    if node is None:
        return Cursor(CursorKind.TEXT, None, Span(offset, offset))
    if node.start < offset <= _inside_end(node):
        return _in_start_tag(node, offset, document.text)
    if node.end_tag is not None and node.end_tag.start < offset:
        return Cursor(CursorKind.END_TAG, node, Span(node.end_tag.start + 2, node.end_tag.start + 2 + len(node.tag)))
    return Cursor(CursorKind.TEXT, node, _run_of_text(node, offset, document.text))


def _inside_end(node: TolerantNode) -> int:
    """Return the last place in a start tag, before its `>` or `/>`."""
    closing = (2 if node.empty else 1) if node.whole_tag else 0
    return node.start_tag.end - closing


def _in_start_tag(node: TolerantNode, offset: int, text: str) -> Cursor:
    if offset <= node.name.end:
        return Cursor(CursorKind.TAG, node, node.name)
    for name, span in node.attributes.items():
        if span.name.start <= offset <= span.name.end:
            return Cursor(CursorKind.ATTRIBUTE, node, span.name, name)
        quoted = span.value.start > span.name.end and text[span.value.start - 1] in "\"'"
        if quoted and span.value.start <= offset <= span.value.end:
            return Cursor(CursorKind.VALUE, node, span.value, name)
    return Cursor(CursorKind.ATTRIBUTE, node, Span(offset, offset))


def _run_of_text(node: TolerantNode, offset: int, text: str) -> Span:
    """Return the text around a place, up to the next tags, without blanks at its ends."""
    inside = node.content
    start = max(text.rfind(">", inside.start, offset) + 1, inside.start)
    end = text.find("<", offset, inside.end)
    end = inside.end if end < 0 else end
    while start < offset and text[start] in _BLANKS:
        start += 1
    while end > offset and text[end - 1] in _BLANKS:
        end -= 1
    return Span(start, end)
