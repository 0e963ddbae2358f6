"""Navigation and renaming: definitions of a name, and all references to it, also in documents connected by includes."""

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from lsprotocol import types

from twinform.compiler.resolve_uris import SearchPath
from twinform.diagnostics import Span
from twinform.file_access import Readable
from twinform.lazy import lazy_pattern
from twinform.passes.structure.rename_parts import RESERVED
from twinform.server.companions import Definition, definition_of, followed_edits, mention_at
from twinform.server.document_names import defined, name_at, names_of, resolve_in, surroundings
from twinform.server.documents import TextDocument
from twinform.server.includes import includes_of, target
from twinform.server.names import ELEMENTS, XACRO_KINDS, Name
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
    return session.settings(document.path).load_options.search


def definitions(session: Session, document: TextDocument, offset: int) -> list[DocumentPlace]:
    """Find the definitions of the name at an offset, or the beginning of the file that is included there."""
    search = search_of(session, document)
    for include in includes_of(document):
        if include.span.start <= offset <= include.span.end:
            path = target(include, document, search)
            other = session.files.document(path) if path is not None else None
            return [DocumentPlace(other, Span(0, 0))] if other is not None else []
    named = mention_at(document, offset)
    if named is not None:
        there = definition_of(session, document, named)
        return [DocumentPlace(there.document, there.name.span)] if there is not None else []
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
    last = _last_step(document, name)
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
    if "::" in name.text and document.schema.format != "mjcf":
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
        model = first_model(other.tree.root) if other is not None else None
        if other is None or model is None or first not in {included_as(include.node, document), model.get("name")}:
            continue
        there = resolve_in(other, replace(name, text=rest, scope=model))
        return [Found(other, each) for each in there]
    return []


def included_as(include: TolerantNode, document: TextDocument) -> str | None:
    """Return the name that an include gives to its model."""
    own = next((child for child in include.children if child.tag == "name"), None)
    return document.tree.text_of(own).of(document.text) if own is not None else None


def first_model(root: TolerantNode | None) -> TolerantNode | None:
    """Return the robot of a URDF, or the first model of an SDF."""
    if root is None or root.tag == "robot":
        return root
    return next((child for child in root.children if child.tag == "model"), None)


def _last_step(document: TextDocument, name: Name) -> str:
    """Return what of a name is that of the thing itself; names of MJCF have no steps."""
    return name.text if document.schema.format == "mjcf" else name.text.rpartition("::")[2]


def _references_to(group: Sequence[TextDocument], last: str) -> Iterator[Found]:
    """Yield all references whose last step is a name."""
    for document in group:
        if last not in document.text:
            continue
        for name in names_of(document):
            if not name.defines and _last_step(document, name) == last:
                yield Found(document, name)


def find_clash(document: TextDocument, new: str, like: Name) -> Name | None:
    """Find a definition that has a new name already and must not share it with `like`."""
    kinds = _ONE_SCOPE if document.schema.format == "sdf" and like.kind in _ONE_SCOPE else {like.kind}
    return next((own[0] for kind in sorted(kinds) if (own := defined(document, new, kind, like.scope))), None)


_ONE_SCOPE = frozenset({"link", "joint", "frame", "model"})
"""The kinds that share a namespace in SDF."""


_XACRO_NAME = lazy_pattern(r"[A-Za-z_]\w*")
_UNFIT = lazy_pattern(r"[<>&\"'\s$]")


class RenameRefusedError(Exception):
    """A name cannot be changed; the message says why."""


def prepare(document: TextDocument, offset: int) -> types.PrepareRenamePlaceholder | None:
    """Return the name at an offset that a rename would change; None if there is none.

    Raises:
        RenameRefusedError: it cannot be changed.
    """
    named = mention_at(document, offset)
    if named is not None:
        return types.PrepareRenamePlaceholder(range=document.positions.range(named.place), placeholder=named.name)
    name = name_at(document, offset)
    if name is None:
        return None
    _refuse_expression(name)
    placeholder = _last_step(document, name)
    return types.PrepareRenamePlaceholder(range=document.positions.range(name.span), placeholder=placeholder)


def rename(session: Session, document: TextDocument, offset: int, new: str) -> types.WorkspaceEdit | None:
    """Return the edits that rename the thing named at an offset, in all documents that refer to it.

    Raises:
        RenameRefusedError: it cannot have the new name.
    """
    named = mention_at(document, offset)
    if named is not None:
        there = definition_of(session, document, named)
        if there is None:
            raise RenameRefusedError(f"no robot is known that has {named.name!r}: where it is defined has to be known")
        document, offset = there.document, there.name.span.start
    name = name_at(document, offset)
    if name is None:
        return None
    _refuse_expression(name)
    what, found = references(session, document, offset)
    if not what:
        raise RenameRefusedError(f"nothing here is called {name.text!r}: where it is defined has to be known")
    for each in what:
        _refuse_unfit(each, new)
    _refuse_outside(session, document, (*what, *found))
    changes: dict[str, list[types.TextEdit]] = {}
    for each in {(one.document.uri, one.name.span): one for one in (*what, *found)}.values():
        if not each.document.tree.whole:
            raise RenameRefusedError(f"{each.document.path.name} is not well-formed: names in it may be missed")
        edit = types.TextEdit(each.document.positions.range(each.name.span), new)
        changes.setdefault(each.document.uri, []).append(edit)
    for each in followed_edits(session, [Definition(*one) for one in what], new):
        changes.setdefault(each.document.uri, []).append(each.edit)
    return types.WorkspaceEdit(changes=changes)


def _refuse_outside(session: Session, document: TextDocument, found: Iterable[Found]) -> None:
    """Refuse to change files outside of the workspace, such as those of installed packages."""
    folders = tuple(os.path.realpath(folder) for folder in session.folders)
    own = Readable(folders) if folders else Readable.of(document.path)
    for path in {each.document.path for each in found} - {document.path}:
        if not own.allows(path):
            raise RenameRefusedError(f"{str(path)!r} would have to change as well, and is outside of the workspace")


def _refuse_expression(name: Name) -> None:
    if name.text in RESERVED:
        raise RenameRefusedError(f"{name.text!r} has a meaning of its own")
    if "$" in name.text:
        raise RenameRefusedError(f"{name.text!r} is made by an expression: rename what is in the expression")


def _refuse_unfit(found: Found, new: str) -> None:
    """Refuse a new name that is invalid or taken."""
    document, name = found
    if name.kind in XACRO_KINDS and not _XACRO_NAME.fullmatch(new):
        raise RenameRefusedError(
            f"{new!r} is not a valid name in xacro: use letters, digits and '_', and no digit first"
        )
    if name.kind == "macro" and new in ELEMENTS:
        raise RenameRefusedError(f"<xacro:{new}> is an element of xacro")
    if not new or _UNFIT.search(new):
        raise RenameRefusedError(f"{new!r} is not a valid name: it must not have blanks, quotes, '<', '>', '&' or '$'")
    if document.schema.format == "sdf" and (new in RESERVED or "::" in new):
        raise RenameRefusedError(f"nothing can be called {new!r} in SDF")
    taken = find_clash(document, new, name)
    if taken is not None and taken.span != name.span:
        line = document.positions.position(taken.span.start).line + 1
        raise RenameRefusedError(f"a {taken.kind} is called {new!r} already: {document.path.name}:{line}")
