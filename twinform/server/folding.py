"""What an editor can fold: elements and comments of several lines."""

from collections.abc import Iterator

from lsprotocol import types

from twinform.diagnostics import Span
from twinform.server.documents import TextDocument


def folds(document: TextDocument) -> list[types.FoldingRange]:
    """The pieces of a document that have several lines; of an element, the line of its end tag stays."""
    return [*_elements(document), *_comments(document)]


def _elements(document: TextDocument) -> Iterator[types.FoldingRange]:
    for node in document.tree.nodes:
        first, last = _lines(document, Span(node.start_tag.start, node.end))
        last -= node.end_tag is not None
        if last > first:
            yield types.FoldingRange(first, last)


def _comments(document: TextDocument) -> Iterator[types.FoldingRange]:
    for aside in document.tree.asides:
        first, last = _lines(document, aside)
        if last > first:
            yield types.FoldingRange(first, last, kind=types.FoldingRangeKind.Comment)


def _lines(document: TextDocument, span: Span) -> tuple[int, int]:
    positions = document.positions
    return positions.position(span.start).line, positions.position(max(span.start, span.end - 1)).line
