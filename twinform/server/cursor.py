"""What stands at the cursor: a tag, the name or the value of an attribute, a text, or a place between elements."""

from dataclasses import dataclass
from enum import Enum, auto

from twinform.diagnostics import Span
from twinform.server.documents import TextDocument
from twinform.server.tolerant_tree import TolerantNode

_BLANKS = " \t\r\n"


class CursorKind(Enum):
    """What it is."""

    TAG = auto()
    """The name of an element in its start tag; the element is the one that is being typed."""
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
    """A place in a document. `piece` is what stands there, `attribute` the one whose name or value it is.

    `node` is the element whose tag it is, or the one around a text; None for a place outside of all elements.
    """

    kind: CursorKind
    node: TolerantNode | None
    piece: Span
    attribute: str | None = None


def cursor_at(document: TextDocument, offset: int) -> Cursor | None:
    """What stands at an offset; None in comments and the like."""
    tree = document.tree
    if tree.aside_at(offset) is not None:
        return None
    node = tree.at(offset)
    if node is None:
        return Cursor(CursorKind.TEXT, None, Span(offset, offset))
    if node.start_tag.start < offset <= _inside_end(node):
        return _in_start_tag(node, offset, document.text)
    if node.end_tag is not None and node.end_tag.start < offset:
        return Cursor(CursorKind.END_TAG, node, Span(node.end_tag.start + 2, node.end_tag.start + 2 + len(node.tag)))
    return Cursor(CursorKind.TEXT, node, _run_of_text(node, offset, document.text))


def _inside_end(node: TolerantNode) -> int:
    """The last place in a start tag, which is before what closes it."""
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
    """The text around a place, up to the tags beside it, without the blanks at its ends."""
    inside = node.content
    start = max(text.rfind(">", inside.start, offset) + 1, inside.start)
    end = text.find("<", offset, inside.end)
    end = inside.end if end < 0 else end
    while start < offset and text[start] in _BLANKS:
        start += 1
    while end > offset and text[end - 1] in _BLANKS:
        end -= 1
    return Span(start, end)
