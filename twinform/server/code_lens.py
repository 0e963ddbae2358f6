"""Code lenses: above each link, joint, frame and macro, how many references to it there are."""

from lsprotocol import types

from twinform.server.document_names import definitions_in
from twinform.server.documents import TextDocument
from twinform.server.navigation import references
from twinform.server.session import Session

SHOW_REFERENCES = "twinform.showReferences"
"""The command of a lens, which the editor has to know; its arguments are the URI and the position of a name."""
_COUNTED = frozenset({"link", "joint", "frame", "macro"})


def lenses(document: TextDocument) -> list[types.CodeLens]:
    """Return a lens for each definition; what it says is found once it is seen."""
    return [
        types.CodeLens(document.positions.range(name.span), data=document.uri)
        for name in definitions_in(document)
        if name.kind in _COUNTED
    ]


def resolve_lens(session: Session, lens: types.CodeLens) -> types.CodeLens:
    """Return a lens with the number of references, also in documents that are connected by includes."""
    document = session.documents.get(lens.data) if isinstance(lens.data, str) else None
    if document is None:
        return lens
    _, found = references(session, document, document.positions.offset(lens.range.start))
    count = len({(each.document.path, each.name.span) for each in found})
    title = f"{count or 'no'} reference{'' if count == 1 else 's'}"
    arguments: list[object] = [document.uri, {"line": lens.range.start.line, "character": lens.range.start.character}]
    return types.CodeLens(lens.range, types.Command(title, SHOW_REFERENCES, arguments=arguments))
