"""The language server: the table of its requests, and the functions that answer them."""

import threading
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Any, TypeVar

from lsprotocol import types
from pygls.exceptions import FeatureRequestError, JsonRpcException, JsonRpcInvalidParams, PyglsError
from pygls.lsp.server import LanguageServer
from pygls.protocol import default_converter

from twinform import __version__
from twinform.server.actions import FIX_ALL, RUN_PASSES, actions, text_edits, word_of
from twinform.server.checking import Rewritten, SettingsOf, format_document, no_settings, run_passes
from twinform.server.closing_tags import TRIGGERS, closing, linked_names
from twinform.server.code_lens import lenses, resolve_lens
from twinform.server.completion import complete
from twinform.server.document_outline import folds, links, outline, search
from twinform.server.documents import TextDocument
from twinform.server.editor_options import EditorOptions
from twinform.server.hover import hover, warm_up
from twinform.server.inlay_hints import inlay_hints
from twinform.server.locations import file_of
from twinform.server.navigation import (
    DocumentPlace,
    RenameRefusedError,
    definitions,
    prepare,
    references,
    rename,
    search_of,
)
from twinform.server.protocol import Protocol
from twinform.server.session import Session
from twinform.server.worker import TaskError, Worker

Answer = TypeVar("Answer")
# Shared by all servers of a process: a converter takes longer to make than a session takes to begin, and the code
# that it generates stays in `linecache` until the process ends.
_converter = cache(default_converter)


class Server(LanguageServer):
    """The server and its session; `on_parent` is called with the process id of the editor, if it sends one."""

    protocol: Protocol  # pyright: ignore[reportIncompatibleVariableOverride] - it is never replaced

    def __init__(self, settings_of: SettingsOf, worker: Worker | None) -> None:
        super().__init__(  # pyright: ignore[reportUnknownMemberType]
            "twinform", __version__, protocol_cls=Protocol, converter_factory=_converter
        )
        self.session = Session(settings_of, self.text_document_publish_diagnostics, worker)
        self.on_parent: Callable[[int], None] | None = None

    def report_server_error(self, error: Exception, source: type[PyglsError] | type[JsonRpcException]) -> None:
        """Log an error in a notification; an error in a request is its answer."""
        if source is not FeatureRequestError:
            self.protocol.log(f"this is a fault of twinform: {error!r}")


def make_server(settings_of: SettingsOf = no_settings, worker: Worker | None = None) -> Server:
    """Make a server that is ready to start."""
    server = Server(settings_of, worker)
    session = server.session
    _begin_and_end(server, session)
    _follow_documents(server, session)
    _help_typing(server, session)
    _answer_at_places(server, session)
    _answer_about_documents(server, session)
    _annotate(server, session)
    _rewrite(server, session)
    return server


def _begin_and_end(server: Server, session: Session) -> None:
    """Take what the editor says of itself and of its folders, and end with it."""

    @server.feature(types.INITIALIZE)
    def initialize(params: types.InitializeParams) -> None:
        session.documents.encoding = types.PositionEncodingKind(server.workspace.position_encoding)
        session.folders = _folders(server)
        text = params.capabilities.text_document
        item = text.completion.completion_item if text and text.completion else None
        session.options = EditorOptions.of(params.initialization_options)
        session.snippets = bool(item and item.snippet_support)
        if params.process_id is not None and server.on_parent is not None:
            server.on_parent(params.process_id)

    @server.feature(types.INITIALIZED)
    def initialized(_: types.InitializedParams) -> None:
        threading.Thread(target=warm_up, daemon=True).start()
        session.check_workspace()

    @server.feature(types.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS)
    def moved(_: types.DidChangeWorkspaceFoldersParams) -> None:
        session.folders = _folders(server)
        session.check_workspace()

    @server.feature(types.SHUTDOWN)
    def shutdown(*_: object) -> None:
        session.stop()


def _follow_documents(server: Server, session: Session) -> None:
    """Keep documents in step with the editor, and with the files that others change."""

    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: types.DidOpenTextDocumentParams) -> None:
        session.opened(params.text_document)

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: types.DidChangeTextDocumentParams) -> None:
        session.changed(params)

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: types.DidCloseTextDocumentParams) -> None:
        session.closed(params.text_document.uri)

    @server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def changed_on_disk(params: types.DidChangeWatchedFilesParams) -> None:
        if any(each.type is not types.FileChangeType.Changed for each in params.changes):
            session.check_workspace()
        for each in params.changes:
            session.changed_on_disk(each.uri)


def _at_place(
    session: Session, params: Any, answer: Callable[[TextDocument, int], Answer], otherwise: Answer
) -> Answer:
    """Answer a request about a place in a document; `otherwise` is the answer if the document is not followed."""
    document = session.documents.get(params.text_document.uri)
    return otherwise if document is None else answer(document, document.positions.offset(params.position))


def _help_typing(server: LanguageServer, session: Session) -> None:
    """Answer what an editor asks while somebody types."""

    @server.feature(types.TEXT_DOCUMENT_COMPLETION, types.CompletionOptions(trigger_characters=list('<"/ :{(')))
    def completed(params: types.CompletionParams) -> types.CompletionList:
        nothing = types.CompletionList(is_incomplete=False, items=[])
        return _at_place(session, params, lambda document, offset: complete(session, document, offset), nothing)

    @server.feature(types.TEXT_DOCUMENT_LINKED_EDITING_RANGE)
    def linked(params: types.LinkedEditingRangeParams) -> types.LinkedEditingRanges | None:
        return _at_place(session, params, linked_names, None)

    @server.feature(
        types.TEXT_DOCUMENT_ON_TYPE_FORMATTING, types.DocumentOnTypeFormattingOptions(TRIGGERS[0], TRIGGERS[1:])
    )
    def typed(params: types.DocumentOnTypeFormattingParams) -> list[types.TextEdit]:
        return _at_place(session, params, lambda document, offset: closing(document, offset, params.ch), [])


def _answer_at_places(server: LanguageServer, session: Session) -> None:
    """Answer requests about a place in a document."""
    at = partial(_at_place, session)

    @server.feature(types.TEXT_DOCUMENT_HOVER)
    def hovered(params: types.HoverParams) -> types.Hover | None:
        return at(params, lambda document, offset: hover(session, document, offset), None)

    @server.feature(types.TEXT_DOCUMENT_DEFINITION)
    def defined(params: types.DefinitionParams) -> list[types.Location]:
        return _locations(at(params, lambda document, offset: definitions(session, document, offset), []))

    @server.feature(types.TEXT_DOCUMENT_REFERENCES)
    def referred(params: types.ReferenceParams) -> list[types.Location]:
        what, found = at(params, lambda document, offset: references(session, document, offset), ([], []))
        wanted = [*what, *found] if params.context.include_declaration else found
        return _locations([each.place for each in wanted])

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT)
    def highlighted(params: types.DocumentHighlightParams) -> list[types.DocumentHighlight]:
        what, found = at(params, lambda document, offset: references(session, document, offset), ([], []))
        own = [each for each in (*what, *found) if each.document.uri == params.text_document.uri]
        return [types.DocumentHighlight(each.document.positions.range(each.name.span)) for each in own]

    @server.feature(types.TEXT_DOCUMENT_PREPARE_RENAME)
    def prepared(params: types.PrepareRenameParams) -> types.PrepareRenamePlaceholder | None:
        return _or_refused(lambda: at(params, prepare, None))

    @server.feature(types.TEXT_DOCUMENT_RENAME, types.RenameOptions(prepare_provider=True))
    def renamed(params: types.RenameParams) -> types.WorkspaceEdit | None:
        return _or_refused(
            lambda: at(params, lambda document, offset: rename(session, document, offset, params.new_name), None)
        )


def _answer_about_documents(server: LanguageServer, session: Session) -> None:
    """Answer requests about a whole document."""

    def about(params: Any, answer: Callable[[TextDocument], list[Answer]]) -> list[Answer]:
        document = session.documents.get(params.text_document.uri)
        return [] if document is None else answer(document)

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def outlined(params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
        return about(params, outline)

    @server.feature(types.WORKSPACE_SYMBOL)
    def searched(params: types.WorkspaceSymbolParams) -> list[types.WorkspaceSymbol]:
        return search(session, params.query)

    @server.feature(types.TEXT_DOCUMENT_FOLDING_RANGE)
    def folded(params: types.FoldingRangeParams) -> list[types.FoldingRange]:
        return about(params, folds)

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_LINK)
    def linked(params: types.DocumentLinkParams) -> list[types.DocumentLink]:
        return about(params, lambda document: links(document, search_of(session, document)))

    @server.feature(
        types.TEXT_DOCUMENT_CODE_ACTION,
        types.CodeActionOptions(
            code_action_kinds=[types.CodeActionKind.QuickFix, types.CodeActionKind.RefactorRewrite, FIX_ALL]
        ),
    )
    def acted(params: types.CodeActionParams) -> list[types.CodeAction]:
        only = None if params.context.only is None else [word_of(each) for each in params.context.only]
        return about(params, lambda document: actions(session, document, params.range, only))


def _annotate(server: LanguageServer, session: Session) -> None:
    """Answer what an editor shows in or above the lines of a document."""

    @server.feature(types.TEXT_DOCUMENT_INLAY_HINT)
    def hinted(params: types.InlayHintParams) -> list[types.InlayHint]:
        document = session.documents.get(params.text_document.uri)
        return [] if document is None else inlay_hints(session, document, params.range)

    @server.feature(types.TEXT_DOCUMENT_CODE_LENS, types.CodeLensOptions(resolve_provider=True))
    def lensed(params: types.CodeLensParams) -> list[types.CodeLens]:
        document = session.documents.get(params.text_document.uri)
        return [] if document is None or not session.options.code_lens else lenses(document)

    @server.feature(types.CODE_LENS_RESOLVE)
    def resolved(lens: types.CodeLens) -> types.CodeLens:
        return resolve_lens(session, lens)


def _rewrite(server: LanguageServer, session: Session) -> None:
    """Change documents as a whole, in the process of the worker."""

    @server.feature(types.TEXT_DOCUMENT_FORMATTING)
    async def formatted(params: types.DocumentFormattingParams) -> list[types.TextEdit]:
        document, done = await _run_rewrite(session, params.text_document.uri, format_document)
        if document is None:
            _tell(server, f"The document cannot be formatted: {done.problem}")
            return []
        return text_edits(document, done.edits)

    @server.command(RUN_PASSES)
    async def run(*arguments: Any) -> None:
        match arguments:
            case (str() as uri, str() as pipeline):
                pass
            case _:
                raise JsonRpcInvalidParams(f"{RUN_PASSES} takes two texts: the URI of a document, and a pipeline")
        document, done = await _run_rewrite(session, uri, run_passes, pipeline)
        if document is None:
            _tell(server, f"{pipeline} has changed nothing: {done.problem}")
        elif not done.edits:
            _tell(server, f"{pipeline} has nothing to change")
        else:
            edit = types.WorkspaceEdit(changes={document.uri: text_edits(document, done.edits)})
            await server.workspace_apply_edit_async(types.ApplyWorkspaceEditParams(edit, f"twinform: {pipeline}"))


async def _run_rewrite(
    session: Session, uri: str, task: Callable[..., Rewritten], *args: str
) -> tuple[TextDocument | None, Rewritten]:
    """Rewrite a document in the worker; without a document in the result, `problem` says why there are no edits."""
    document, job = session.documents.get(uri), session.job(uri)
    if document is None or job is None:
        return None, Rewritten(problem="it is not open, or too large")
    try:
        done = await session.worker.run(task, job, *args)
    except TaskError as error:
        return None, Rewritten(problem=str(error))
    if session.documents.get(uri) is not document:
        return None, Rewritten(problem="the document was changed in the meantime; ask again")
    return None if done.problem else document, done


def _folders(server: Server) -> list[Path]:
    """Return the folders of the workspace that are on this machine."""
    found = [file_of(uri) for uri in server.workspace.folders]
    return [each for each in found if each is not None]


def _tell(server: LanguageServer, message: str) -> None:
    # editors turn `[text](command:...)` into links, and a message may quote the file
    message = message.replace("](", "] (")
    server.window_show_message(types.ShowMessageParams(types.MessageType.Warning, message))


def _locations(places: list[DocumentPlace]) -> list[types.Location]:
    return [types.Location(each.document.uri, each.document.positions.range(each.span)) for each in places]


def _or_refused(answer: Callable[[], Answer]) -> Answer:
    """Return an answer, or raise the protocol's error if the rename is refused."""
    try:
        return answer()
    except RenameRefusedError as error:
        raise JsonRpcInvalidParams(str(error)) from error
