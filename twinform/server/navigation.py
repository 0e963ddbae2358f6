"""Navigation: the definitions of a name, and all references to it, also in documents connected by includes."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from twinform.compiler.resolve_uris import SearchPath
from twinform.diagnostics import Span
from twinform.server.document_names import defined, name_at, names_of, resolve_in, surroundings
from twinform.server.documents import TextDocument
from twinform.server.includes import includes_of, target
from twinform.server.names import XACRO_KINDS, Name
from twinform.server.session import Session
from twinform.server.tolerant_tree import TolerantNode


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
        """The place of the name."""
        return DocumentPlace(self.document, self.name.span)


def search_of(session: Session, document: TextDocument) -> SearchPath:
    """Return the search path for the URIs of a document."""
    return session.settings_of(document.path).load_options.search


def definitions(session: Session, document: TextDocument, offset: int) -> list[DocumentPlace]:
    """Find the definitions of the name at an offset, or the beginning of the file that is included there."""
    search = search_of(session, document)
    for include in includes_of(document):
        if include.span.start <= offset <= include.span.end:
            path = target(include, document, search)
            other = session.files.document(path) if path is not None else None
            return [DocumentPlace(other, Span(0, 0))] if other is not None else []
    name = name_at(document, offset)
    if name is None:
        return []
    group = session.neighbors.included(document, search)
    return [each.place for each in resolve(Found(document, name), group, session)]


def references(session: Session, document: TextDocument, offset: int) -> tuple[list[Found], list[Found]]:
    """Find the definitions of the name at an offset, and all references to them."""
    name = name_at(document, offset)
    if name is None:
        return [], []
    folders = session.folders or [document.path.parent]
    group = session.neighbors.connected(document, search_of(session, document), folders)
    what = resolve(Found(document, name), group, session)
    wanted = {(each.document.path, each.name.span) for each in what}
    last = name.text.rpartition("::")[2]
    known: dict[object, bool] = {}
    found: list[Found] = []
    for each in _references_to(group, last):
        # a file may refer to a name a hundred thousand times, and define it as often
        key = _resolution_key(each)
        if key not in known:
            known[key] = any((one.document.path, one.name.span) in wanted for one in resolve(each, group, session))
        if known[key]:
            found.append(each)
    return what, found


def _resolution_key(found: Found) -> object:
    """Return everything that the definitions of a name depend on."""
    document, name = found
    macro = surroundings(document, name.node).macro if name.kind in XACRO_KINDS else None
    return document.path, name.text, name.kind, name.scope, macro


def resolve(found: Found, group: Sequence[TextDocument], session: Session) -> list[Found]:
    """Find the definitions of a name: in its document, else in an include, else in the other documents of a group."""
    document, name = found
    if name.defines:
        alike = [each for each in resolve_in(document, name) if each.kind == name.kind and each.scope is name.scope]
        return [Found(document, each) for each in alike] or [found]
    here = [Found(document, each) for each in resolve_in(document, name)]
    if here or (name.scope is not None and document.schema.format == "sdf" and "::" not in name.text):
        return here
    if "::" in name.text:
        return _resolve_in_include(found, session)
    for other in group:
        there = [] if other.path == document.path else resolve_in(other, replace(name, scope=None))
        if there:
            return [Found(other, each) for each in there]
    return []


def _resolve_in_include(found: Found, session: Session) -> list[Found]:
    """Find the definitions of `include::part` in the file that is included."""
    document, name = found
    first, _, rest = name.text.partition("::")
    search = search_of(session, document)
    for include in includes_of(document):
        path = target(include, document, search)
        other = session.files.document(path) if path is not None else None
        model = _first_model(other.tree.root) if other is not None else None
        if other is None or model is None or first not in {_included_as(include.node, document), model.get("name")}:
            continue
        there = resolve_in(other, replace(name, text=rest, scope=model))
        return [Found(other, each) for each in there]
    return []


def _included_as(include: TolerantNode, document: TextDocument) -> str | None:
    """Return the name that an include gives to its model."""
    own = next((child for child in include.children if child.tag == "name"), None)
    return document.tree.text_of(own).of(document.text) if own is not None else None


def _first_model(root: TolerantNode | None) -> TolerantNode | None:
    """Return the robot of a URDF, or the first model of an SDF."""
    if root is None or root.tag == "robot":
        return root
    return next((child for child in root.children if child.tag == "model"), None)


def _references_to(group: Sequence[TextDocument], last: str) -> Iterator[Found]:
    """Yield all references whose last step is a name."""
    for document in group:
        if last not in document.text:
            continue
        for name in names_of(document):
            if not name.defines and name.text.rpartition("::")[2] == last:
                yield Found(document, name)


def find_clash(document: TextDocument, new: str, like: Name) -> Name | None:
    """Find a definition that has a new name already and must not share it with `like`."""
    kinds = {like.kind} if document.schema.format == "urdf" or like.kind not in _ONE_SCOPE else _ONE_SCOPE
    return next((own[0] for kind in sorted(kinds) if (own := defined(document, new, kind, like.scope))), None)


_ONE_SCOPE = frozenset({"link", "joint", "frame", "model"})
"""The kinds that share a namespace in SDF."""
