"""The names that somebody may mean at a place: those of the document, of its last good state, and of its includes."""

from collections.abc import Iterator

from twinform.ir.references import ReferenceKind
from twinform.passes.structure.rename_parts import LOOKUP_ORDER
from twinform.server.document_names import names_of, scope_of_reference
from twinform.server.documents import TextDocument
from twinform.server.name import Name
from twinform.server.navigation import search_of
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode


def names_for(session: Session, document: TextDocument, node: TolerantNode, kind: ReferenceKind) -> Iterator[Name]:
    """The names of a kind that an element may refer to, each once."""
    scope = scope_of_reference(document, node)
    wanted = scope.get("name") if scope is not None and document.schema.format == "sdf" else None
    kinds = _kinds(kind, document)
    seen: set[str] = set()
    for other in _documents(session, document):
        for name in names_of(other):
            where = name.scope.get("name") if name.scope is not None else None
            fits = name.defines and name.kind in kinds and (wanted is None or where == wanted)
            if fits and name.text not in seen:
                seen.add(name.text)
                yield name


def names_of_kind(session: Session, document: TextDocument, *kinds: str) -> Iterator[Name]:
    """The definitions of some kinds, each name once."""
    seen: set[str] = set()
    for other in _documents(session, document):
        for name in names_of(other):
            if name.defines and name.kind in kinds and name.text not in seen:
                seen.add(name.text)
                yield name


def _kinds(kind: ReferenceKind, document: TextDocument) -> tuple[str, ...]:
    """The kinds that are proposed: in URDF only that one itself."""
    if kind not in LOOKUP_ORDER:
        return (kind,)
    if document.schema.format == "urdf" or kind in {"link", "joint"}:
        return LOOKUP_ORDER[kind][:2] if kind != "joint" else ("joint",)
    return LOOKUP_ORDER[kind]


def _documents(session: Session, document: TextDocument) -> Iterator[TextDocument]:
    yield document
    # While somebody types, half of the document may be inside an element that is not closed yet.
    good = session.documents.last_good(document)
    if good is not None and good is not document:
        yield good
    if document.is_xacro:
        yield from session.neighbors.included(document, search_of(session, document))[1:]
