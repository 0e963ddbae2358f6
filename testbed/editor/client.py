"""An editor that talks to the installed command, for tests: pygls' own client over standard input and output."""

# pygls has no types for these:
# pyright: reportUntypedFunctionDecorator=false, reportUnknownMemberType=false

import asyncio
import sys
from collections.abc import AsyncGenerator, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

from lsprotocol import types
from pygls.lsp.client import LanguageClient

SECONDS = 60
"""The longest that any answer may take, on a machine that is busy."""


class _Client(LanguageClient):
    """A client that knows how the server has ended."""

    def __init__(self) -> None:
        super().__init__("test", "1")
        self.ended: asyncio.Future[int | None] = asyncio.get_running_loop().create_future()

    async def server_exit(self, server: asyncio.subprocess.Process) -> None:
        self.ended.set_result(server.returncode)


class Editor:
    """A client with the documents that it has open, and the diagnostics that it was told."""

    def __init__(self) -> None:
        self.client = _Client()
        self.told: dict[str, types.PublishDiagnosticsParams] = {}
        self.news = asyncio.Event()
        self.edits: list[types.ApplyWorkspaceEditParams] = []
        self.capabilities = types.ServerCapabilities()
        self.versions: dict[str, int] = {}

        @self.client.feature(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def told(params: types.PublishDiagnosticsParams) -> None:
            self.told[params.uri] = params
            self.news.set()

        @self.client.feature(types.WORKSPACE_APPLY_EDIT)
        def edit(params: types.ApplyWorkspaceEditParams) -> types.ApplyWorkspaceEditResult:
            self.edits.append(params)
            return types.ApplyWorkspaceEditResult(applied=True)

        @self.client.feature(types.WINDOW_SHOW_MESSAGE)
        def message(params: types.ShowMessageParams) -> None:
            self.messages.append(params.message)

        self.messages: list[str] = []

    async def request(self, method: str, params: Any) -> Any:
        """The answer to a request."""
        return await asyncio.wait_for(self.client.protocol.send_request_async(method, params), SECONDS)

    def open(self, path: Path, text: str | None = None, language: str = "urdf") -> str:
        """Open a file, with another text if one is given."""
        uri = path.as_uri()
        text = path.read_text(encoding="utf-8") if text is None else text
        self.versions[uri] = 1
        item = types.TextDocumentItem(uri, language, 1, text)
        self.client.text_document_did_open(types.DidOpenTextDocumentParams(item))
        return uri

    def change(self, uri: str, *changes: tuple[tuple[int, int, int, int], str] | str) -> int:
        """Replace a range, or the whole text."""
        self.versions[uri] += 1
        made: list[types.TextDocumentContentChangeEvent] = []
        for each in changes:
            if isinstance(each, str):
                made.append(types.TextDocumentContentChangeWholeDocument(each))
            else:
                (line, column, end_line, end_column), new = each
                where = types.Range(types.Position(line, column), types.Position(end_line, end_column))
                made.append(types.TextDocumentContentChangePartial(where, new))
        item = types.VersionedTextDocumentIdentifier(self.versions[uri], uri)
        self.client.text_document_did_change(types.DidChangeTextDocumentParams(item, made))
        return self.versions[uri]

    def close(self, uri: str) -> None:
        """Close a document."""
        item = types.TextDocumentIdentifier(uri)
        self.client.text_document_did_close(types.DidCloseTextDocumentParams(item))

    async def diagnostics(
        self, uri: str, version: int | None = None, until: Callable[[list[types.Diagnostic]], bool] | None = None
    ) -> list[types.Diagnostic]:
        """The diagnostics of a document: those of a version, or those that are as wanted."""

        async def wait() -> list[types.Diagnostic]:
            while True:
                found = self.told.get(uri)
                if found is not None and version in (None, found.version):
                    listed = list(found.diagnostics)
                    if until is None or until(listed):
                        return listed
                self.news.clear()
                await self.news.wait()

        return await asyncio.wait_for(wait(), SECONDS)


@asynccontextmanager
async def editor(
    folder: Path, encodings: list[types.PositionEncodingKind] | None = None, options: object = None
) -> AsyncGenerator[Editor]:
    """An editor with a folder open; the server has ended properly behind it."""
    one = Editor()
    command = [sys.executable, "-m", "twinform", "lsp"]
    await one.client.start_io(command[0], *command[1:], cwd=str(folder))
    general = types.GeneralClientCapabilities(position_encodings=encodings)
    capabilities = types.ClientCapabilities(general=general)
    folders = [types.WorkspaceFolder(folder.as_uri(), folder.name)]
    params = types.InitializeParams(
        capabilities=capabilities, workspace_folders=folders, initialization_options=options
    )
    started = await one.request(types.INITIALIZE, params)
    one.capabilities = started.capabilities
    one.client.initialized(types.InitializedParams())
    try:
        yield one
    finally:
        await one.request(types.SHUTDOWN, None)
        one.client.exit(None)
        assert await asyncio.wait_for(one.client.ended, SECONDS) == 0
        await one.client.stop()
