"""Closing tags: end tags that are written while somebody types, and the two names of an element, changed together."""

from lsprotocol import types

from twinform.diagnostics import Span, TextEdit
from twinform.lazy import lazy_pattern
from twinform.server.documents import TextDocument
from twinform.server.tolerant_tree import TolerantNode

TRIGGERS = (">", "/")
"""The characters behind which a tag may be closed."""
_NAME = lazy_pattern(r"[^\s<>/]")


def linked_names(document: TextDocument, offset: int) -> types.LinkedEditingRanges | None:
    """Return the names in both tags of an element, if an offset is in one of them."""
    node = document.tree.at(offset)
    if node is None or node.end_tag is None or document.tree.aside_at(offset) is not None:
        return None
    start = node.end_tag.start + len("</")
    names = (node.name, Span(start, start + len(node.tag)))
    if not any(span.start <= offset <= span.end for span in names):
        return None
    return types.LinkedEditingRanges([document.positions.range(span) for span in names])


def closing(document: TextDocument, offset: int, typed: str) -> list[types.TextEdit]:
    """Return the edit that closes a tag behind a `>` or `</` that was typed before an offset; none if nothing is open.

    An end tag that stands behind a `</` with nothing but blanks between is replaced: it was written when the element
    began, and its author goes on as if it were not there.
    """
    begun = {">": ">", "/": "</"}.get(typed, "")
    is_typed = bool(begun) and document.text.endswith(begun, 0, offset)
    if not is_typed or document.tree.aside_at(offset) is not None:
        return []
    node = document.tree.at(offset - len(begun) + 1 if typed == ">" else offset - len(begun))
    if node is None:
        return []
    edit = _close_element(node, offset) if typed == ">" else _close_tag(document, node, offset)
    return [types.TextEdit(document.positions.range(edit.span), edit.new)] if edit else []


def _close_element(node: TolerantNode, offset: int) -> TextEdit | None:
    """Write the end tag of an element whose start tag ends at an offset."""
    is_begun = node.whole_tag and not node.empty and node.start_tag.end == offset
    return TextEdit(Span(offset, offset), f"</{node.tag}>") if is_begun and _needs_end_tag(node) else None


def _close_tag(document: TextDocument, node: TolerantNode, offset: int) -> TextEdit | None:
    """Complete the `</` before an offset inside of an element."""
    if not node.whole_tag or _NAME.match(document.text, offset):
        return None
    rest = "" if document.text.startswith(">", offset) else ">"
    if _needs_end_tag(node):
        return TextEdit(Span(offset, offset), f"{node.tag}{rest}")
    own = node.end_tag
    if own is None or document.text[offset : own.start].strip():
        return None
    return TextEdit(Span(offset, own.end), f"{node.tag}>")


def _needs_end_tag(node: TolerantNode) -> bool:
    """Whether an element has no end tag, or has taken that of an element of the same name around it."""
    if not node.closed:
        return True
    above = node.parent
    while above is not None and (above.tag != node.tag or above.closed):
        above = above.parent
    return above is not None
