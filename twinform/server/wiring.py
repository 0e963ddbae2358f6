"""The language server itself: which request is answered by which function, on standard input and output."""

import logging

from lsprotocol import types
from pygls.lsp.server import LanguageServer

from twinform import __version__
from twinform.server.documents import path_of
from twinform.server.protocol import Protocol
from twinform.server.session import Session
from twinform.server.settings import SettingsOf, no_settings


def serve(settings_of: SettingsOf = no_settings) -> None:
    """Talk to an editor until it says that it is done."""
    logging.getLogger("pygls").setLevel(logging.ERROR)
    make_server(settings_of).start_io()


def make_server(settings_of: SettingsOf = no_settings) -> LanguageServer:
    """A server that is ready to start."""
    server = LanguageServer("twinform", __version__, protocol_cls=Protocol)
    session = Session(settings_of, server.text_document_publish_diagnostics)
    _follow_documents(server, session)
    return server


def _follow_documents(server: LanguageServer, session: Session) -> None:
    """Keep documents in step, from the beginning of the session to its end."""

    @server.feature(types.INITIALIZE)
    def initialize(params: types.InitializeParams) -> None:
        session.documents.encoding = types.PositionEncodingKind(server.workspace.position_encoding)
        session.folders = [path_of(each.uri) for each in params.workspace_folders or ()]

    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: types.DidOpenTextDocumentParams) -> None:
        session.opened(params.text_document)

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: types.DidChangeTextDocumentParams) -> None:
        session.changed(params)

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: types.DidCloseTextDocumentParams) -> None:
        session.closed(params.text_document.uri)

    @server.feature(types.SHUTDOWN)
    def shutdown(*_: object) -> None:
        session.stop()
