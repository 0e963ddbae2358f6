"""Completion: elements, attributes and values by the facts tables, names of the document, files, and what xacro has."""

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple

from lsprotocol import types

from twinform.compiler.companions.find_robots import is_semantic
from twinform.diagnostics import Span
from twinform.server.completion.elements import propose_attributes, propose_elements, propose_roots
from twinform.server.completion.proposals import ITEM, ElementPlace, Proposal, ValuePlace, completion_list
from twinform.server.completion.srdf import (
    propose_attributes_of_srdf,
    propose_elements_of_srdf,
    propose_values_of_srdf,
)
from twinform.server.completion.values import propose_values
from twinform.server.completion.xacro import propose_in_expression
from twinform.server.documents import Cursor, CursorKind, TextDocument, cursor_at
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode

__all__ = ["complete"]


class _Providers(NamedTuple):
    """What proposes the parts of documents of one kind."""

    elements: Callable[[ElementPlace], Iterable[Proposal]]
    attributes: Callable[..., Iterable[Proposal]]
    values: Callable[[ValuePlace], Iterable[Proposal]]


_MODELS = _Providers(propose_elements, propose_attributes, propose_values)
_SRDF = _Providers(propose_elements_of_srdf, propose_attributes_of_srdf, propose_values_of_srdf)


def _providers(document: TextDocument) -> _Providers:
    return _SRDF if is_semantic(document.path) else _MODELS


def complete(session: Session, document: TextDocument, offset: int) -> types.CompletionList:
    """List what may be written at an offset, in place of the word that is there."""
    cursor = cursor_at(document, offset)
    if cursor is None:
        return types.CompletionList(is_incomplete=False, items=[])
    found = propose_in_expression(session, document, offset) or _propose(session, document, cursor, offset)
    return completion_list(session, document, *found)


def _propose(session: Session, document: TextDocument, cursor: Cursor, offset: int) -> tuple[Span, Iterable[Proposal]]:
    node = cursor.node
    match cursor.kind:
        case CursorKind.TAG if node is not None:
            return cursor.piece, _elements(session, document, node.parent, node)
        case CursorKind.ATTRIBUTE if node is not None:
            propose = _providers(document).attributes
            return cursor.piece, propose(session, document, node, named=cursor.attribute is not None)
        case CursorKind.VALUE if node is not None and cursor.attribute is not None:
            place = _value_place(session, document, node, cursor, offset)
            return cursor.piece, _providers(document).values(place)
        case CursorKind.END_TAG if node is not None:
            return cursor.piece, [Proposal(node.tag, node.tag, ITEM.Property)]
        case _:
            return _in_text(session, document, cursor, offset)


def _value_place(
    session: Session, document: TextDocument, node: TolerantNode, cursor: Cursor, offset: int
) -> ValuePlace:
    typed = document.text[cursor.piece.start : offset]
    return ValuePlace(session, document, node, cursor.attribute, typed)


def _in_text(session: Session, document: TextDocument, cursor: Cursor, offset: int) -> tuple[Span, Iterable[Proposal]]:
    """Propose an end tag that was begun, values for the text of an element, or elements."""
    node = cursor.node
    start = document.text.rfind("<", 0, offset)
    if start >= 0 and document.text.startswith("</", start) and ">" not in document.text[start:offset]:
        tag = [Proposal(f"/{node.tag}", f"{node.tag}>", ITEM.Property)] if node is not None else []
        return Span(start + 2, offset), tag
    if node is not None and not node.children:
        values = list(_providers(document).values(_value_place(session, document, node, cursor, offset)))
        if values:
            return cursor.piece, values
    empty = Span(offset, offset)
    piece = cursor.piece if "<" not in cursor.piece.of(document.text) and cursor.piece.end == offset else empty
    return piece, _with_bracket(_elements(session, document, node, None))


def _with_bracket(found: Iterable[Proposal]) -> Iterator[Proposal]:
    for each in found:
        yield Proposal(each.label, f"<{each.new}", each.kind, each.detail, each.text, each.rank)


def _elements(
    session: Session, document: TextDocument, parent: TolerantNode | None, own: TolerantNode | None
) -> Iterable[Proposal]:
    if parent is None:
        return propose_roots(document) if document.tree.root in (None, own) else ()
    bare = own is not None and own.whole_tag
    return _providers(document).elements(ElementPlace(session, document, parent, own, bare))
