"""Code actions: fixes of findings, and passes that change a document in place."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from lsprotocol import types

from twinform.diagnostics import Fix, Safety, Span, TextEdit
from twinform.server.diagnostics import DocumentOf, as_protocol, span_of
from twinform.server.documents import TextDocument
from twinform.server.mapping import FormatName
from twinform.server.session import Session

RUN_PASSES = "twinform.runPasses"
"""The command that runs a pipeline on a document; its arguments are the URI and the pipeline."""
FIX_ALL = "source.fixAll.twinform"


class PassAction(NamedTuple):
    """A pipeline that is offered for documents of these formats that contain one of the words `needs`, if any."""

    pipeline: str
    title: str
    formats: tuple[FormatName, ...] = ("urdf", "sdf")
    needs: tuple[str, ...] = ()


PASSES = (
    PassAction("fill-inertia", "Give links without inertia one, from their shapes"),
    PassAction("balance-inertia", "Fix physically impossible inertias", needs=("<inertia",)),
    PassAction(
        "fill-limits{effort=100 velocity=3.14}", "Fill in missing limits: effort 100, velocity 3.14", needs=("<joint",)
    ),
    PassAction("replace-continuous", "Make continuous joints revolute, without limits", needs=("continuous",)),
    PassAction("lump-fixed-joints", "Lump the links on fixed joints into those that hold them", needs=("fixed",)),
    PassAction(
        "migrate-gazebo-classic", "Migrate from Gazebo Classic to gz-sim", needs=("libgazebo_ros", "lib", "<gazebo")
    ),
    PassAction("materials{pbr=true}", "Give materials the colors that gz-sim renders", ("sdf",), ("<material",)),
)


def actions(
    session: Session, document: TextDocument, where: types.Range, only: Iterable[str] | None
) -> list[types.CodeAction]:
    """List the code actions for a range of a document, of all kinds or of `only` some."""
    wanted = None if only is None else tuple(only)
    made = [*_offer_fixes(session, document, where), *_offer_fix_all(session, document), *_offer_passes(document)]
    return [each for each in made if each.kind is not None and _is_wanted(word_of(each.kind), wanted)]


def word_of(kind: types.CodeActionKind | str) -> str:
    """Return the kind of an action as the protocol writes it."""
    return str(kind.value) if isinstance(kind, types.CodeActionKind) else kind


def _is_wanted(kind: str, wanted: tuple[str, ...] | None) -> bool:
    if wanted is None:
        return not kind.startswith("source.")
    return any(kind == each or kind.startswith(f"{each}.") or not each for each in wanted)


def _offer_fixes(session: Session, document: TextDocument, where: types.Range) -> Iterator[types.CodeAction]:
    piece = document.positions.span(where)
    for found in session.findings(document):
        here = span_of(found.location, document)
        fix = found.fix
        if fix is None or fix.safety is Safety.DISPLAY or here.end < piece.start or here.start > piece.end:
            continue
        edit = edit_of(document, fix.edits, session.files.document)
        if edit is None:
            continue
        yield types.CodeAction(
            title=fix.title if fix.safety is Safety.SAFE else f"{fix.title} (the model may change)",
            kind=types.CodeActionKind.QuickFix,
            diagnostics=[as_protocol(found, document, session.files.document)],
            is_preferred=fix.safety is Safety.SAFE,
            edit=edit,
        )


def _offer_fix_all(session: Session, document: TextDocument) -> Iterator[types.CodeAction]:
    fixes = (each.fix for each in session.findings(document))
    own = (fix for fix in fixes if fix is not None and not any(edit.file for edit in fix.edits))
    edits = compatible_edits(fix for fix in own if fix.safety is Safety.SAFE)
    if edits:
        yield types.CodeAction(
            title="Fix all safe problems of the file", kind=FIX_ALL, edit=edit_of(document, edits), is_preferred=True
        )


def compatible_edits(fixes: Iterable[Fix]) -> tuple[TextEdit, ...]:
    """Return the edits of fixes, without a fix that overlaps one before it or inserts at the same place."""
    taken: list[TextEdit] = []
    for fix in fixes:
        if not any(_meet(one.span, other.span) for one in fix.edits for other in taken):
            taken.extend(fix.edits)
    return tuple(sorted(taken, key=lambda edit: edit.span))


def _meet(one: Span, other: Span) -> bool:
    return one == other or (one.start < other.end and other.start < one.end)


def _offer_passes(document: TextDocument) -> Iterator[types.CodeAction]:
    if document.is_xacro or not document.tree.whole:
        return  # a pass would change the expanded file
    for each in PASSES:
        if document.format in each.formats and (not each.needs or any(word in document.text for word in each.needs)):
            command = types.Command(each.title, RUN_PASSES, arguments=[document.uri, each.pipeline])
            yield types.CodeAction(title=each.title, kind=types.CodeActionKind.RefactorRewrite, command=command)


def edit_of(
    document: TextDocument, edits: Iterable[TextEdit], document_of: DocumentOf = lambda _: None
) -> types.WorkspaceEdit | None:
    """Convert edits of a document, and of files that they name, to an edit of the workspace; None if one is unknown."""
    changes: dict[str, list[types.TextEdit]] = {}
    for edit in edits:
        changed = document_of(Path(edit.file)) if edit.file else document
        if changed is None:
            return None
        changes.setdefault(changed.uri, []).extend(text_edits(changed, [edit]))
    return types.WorkspaceEdit(changes=changes)


def text_edits(document: TextDocument, edits: Iterable[TextEdit]) -> list[types.TextEdit]:
    """Convert edits to those of the protocol, which counts a byte order mark as a character."""
    mark = document.text.startswith("\ufeff")
    return [
        types.TextEdit(document.positions.range(Span(span.start + mark, span.end + mark)), new)
        for span, new, _ in edits
    ]
