"""Rename: a definition and all references to it; a name that does not fit is refused."""

import os
import re
from collections.abc import Iterable

from lsprotocol import types

from twinform.file_access import Readable
from twinform.passes.structure.rename_parts import RESERVED
from twinform.server.document_names import name_at
from twinform.server.documents import TextDocument
from twinform.server.names import ELEMENTS, XACRO_KINDS, Name
from twinform.server.navigation import Found, find_clash, references
from twinform.server.session import Session

_XACRO_NAME = re.compile(r"[A-Za-z_]\w*")
_UNFIT = re.compile(r"[<>&\"'\s$]")


class RenameRefusedError(Exception):
    """A name cannot be changed; the message says why."""


def prepare(document: TextDocument, offset: int) -> types.PrepareRenamePlaceholder | None:
    """Return the name at an offset that a rename would change; None if there is none.

    Raises:
        RenameRefusedError: it cannot be changed.
    """
    name = name_at(document, offset)
    if name is None:
        return None
    _refuse_expression(name)
    placeholder = name.text.rpartition("::")[2]
    return types.PrepareRenamePlaceholder(range=document.positions.range(name.span), placeholder=placeholder)


def rename(session: Session, document: TextDocument, offset: int, new: str) -> types.WorkspaceEdit | None:
    """Return the edits that rename the thing named at an offset, in all documents that refer to it.

    Raises:
        RenameRefusedError: it cannot have the new name.
    """
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
