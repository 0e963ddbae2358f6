"""Where a name is defined, and what refers to it: in its document, and in those connected with it by includes."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from twinform.compiler.search.resolve_uris import SearchPath
from twinform.diagnostics import Span
from twinform.server.document_names import defined, found_in, name_at, names_of, surroundings
from twinform.server.documents import TextDocument
from twinform.server.includes import includes_of, target
from twinform.server.name import Name
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode
from twinform.server.xacro_names import XACRO_KINDS


class DocumentPlace(NamedTuple):
    """A piece of a document."""

    document: TextDocument
    span: Span


class Found(NamedTuple):
    """A name in a document."""

    document: TextDocument
    name: Name

    @property
    def place(self) -> DocumentPlace:
        """Where it stands."""
        return DocumentPlace(self.document, self.name.span)


def search_of(session: Session, document: TextDocument) -> SearchPath:
    """The folders in which the URIs of a document are looked up."""
    return session.settings_of(document.path).load_options.search


def definitions(session: Session, document: TextDocument, offset: int) -> list[DocumentPlace]:
    """Where the name at an offset is defined, or the file begins that an include there names."""
    search = search_of(session, document)
    for include in includes_of(document):
        if include.span.start <= offset <= include.span.end:
            path = target(include, document, search)
            other = session.files.document(path) if path is not None else None
            return [DocumentPlace(other, Span(0, 0))] if other is not None else []
    name = name_at(document, offset)
    if name is None:
        return []
    return [
        each.place for each in meant_by(Found(document, name), session.neighbors.included(document, search), session)
    ]


def references(session: Session, document: TextDocument, offset: int) -> tuple[list[Found], list[Found]]:
    """What the name at an offset means, and all that refer to it; the definitions are not among the latter."""
    name = name_at(document, offset)
    if name is None:
        return [], []
    group = connected(session, document)
    what = meant_by(Found(document, name), group, session)
    wanted = {(each.document.path, each.name.span) for each in what}
    last = name.text.rpartition("::")[2]
    known: dict[object, bool] = {}
    found: list[Found] = []
    for each in _called(group, last):
        # a file may refer to a name a hundred thousand times, and define it as often
        key = _what_decides(each)
        if key not in known:
            known[key] = any((one.document.path, one.name.span) in wanted for one in meant_by(each, group, session))
        if known[key]:
            found.append(each)
    return what, found


def _what_decides(found: Found) -> object:
    """What the meaning of a name depends on: two names with the same have the same meaning."""
    document, name = found
    macro = surroundings(document, name.node).macro if name.kind in XACRO_KINDS else None
    return document.path, name.text, name.kind, name.scope, macro


def connected(session: Session, document: TextDocument) -> list[TextDocument]:
    """The documents in which a name of this one may stand."""
    folders = session.folders or [document.path.parent]
    return session.neighbors.connected(document, search_of(session, document), folders)


def meant_by(found: Found, group: Sequence[TextDocument], session: Session) -> list[Found]:
    """The definitions that a name means: in its document, else in an include, else in the others of its group."""
    document, name = found
    if name.defines:
        alike = [each for each in found_in(document, name) if each.kind == name.kind and each.scope is name.scope]
        return [Found(document, each) for each in alike] or [found]
    here = [Found(document, each) for each in found_in(document, name)]
    if here or (name.scope is not None and document.schema.format == "sdf" and "::" not in name.text):
        return here
    if "::" in name.text:
        return _in_included_model(found, session)
    for other in group:
        there = [] if other.path == document.path else found_in(other, replace(name, scope=None))
        if there:
            return [Found(other, each) for each in there]
    return []


def _in_included_model(found: Found, session: Session) -> list[Found]:
    """What `include::part` means in the file that is included."""
    document, name = found
    first, _, rest = name.text.partition("::")
    search = search_of(session, document)
    for include in includes_of(document):
        path = target(include, document, search)
        other = session.files.document(path) if path is not None else None
        model = _model(other.tree.root) if other is not None else None
        if other is None or model is None or first not in {_called_as(include.node, document), model.get("name")}:
            continue
        there = found_in(other, replace(name, text=rest, scope=model))
        return [Found(other, each) for each in there]
    return []


def _called_as(include: TolerantNode, document: TextDocument) -> str | None:
    """The name that an include gives to its model."""
    own = next((child for child in include.children if child.tag == "name"), None)
    return document.tree.text_of(own).of(document.text) if own is not None else None


def _model(root: TolerantNode | None) -> TolerantNode | None:
    """The model of a file."""
    if root is None or root.tag == "robot":
        return root
    return next((child for child in root.children if child.tag == "model"), None)


def _called(group: Sequence[TextDocument], last: str) -> Iterator[Found]:
    """All references whose last step is a name."""
    for document in group:
        if last not in document.text:
            continue
        for name in names_of(document):
            if not name.defines and name.text.rpartition("::")[2] == last:
                yield Found(document, name)


def is_taken(document: TextDocument, new: str, like: Name) -> Name | None:
    """What is called so already, where the two names would be the same."""
    kinds = {like.kind} if document.schema.format == "urdf" or like.kind not in _ONE_SCOPE else _ONE_SCOPE
    return next((own[0] for kind in sorted(kinds) if (own := defined(document, new, kind, like.scope))), None)


_ONE_SCOPE = frozenset({"link", "joint", "frame", "model"})
"""What shares its names in SDF."""
