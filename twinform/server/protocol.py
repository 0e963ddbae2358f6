"""The protocol of pygls with our own store of documents.

That of pygls goes through all lines of a text for each key, and takes more characters for line ends than the protocol
has: after one of them every later change would be made in the wrong place.
"""

from collections.abc import Generator
from typing import Any

from lsprotocol import types
from pygls.protocol import LanguageServerProtocol
from pygls.protocol.language_server import lsp_method

Call = Generator[tuple[Any, tuple[Any], None], Any, None]
"""What pygls is to call: a handler, its arguments, and no names for them."""


class Protocol(LanguageServerProtocol):
    """Hands notifications about documents to our handlers, and does nothing else with them."""

    @lsp_method(types.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: types.DidOpenTextDocumentParams) -> Call:
        """A document was opened."""
        yield self._handler(types.TEXT_DOCUMENT_DID_OPEN), (params,), None

    @lsp_method(types.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(self, params: types.DidChangeTextDocumentParams) -> Call:
        """Something was typed."""
        yield self._handler(types.TEXT_DOCUMENT_DID_CHANGE), (params,), None

    @lsp_method(types.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: types.DidCloseTextDocumentParams) -> Call:
        """A document was closed."""
        yield self._handler(types.TEXT_DOCUMENT_DID_CLOSE), (params,), None

    def _handler(self, method: str) -> Any:
        return self.fm.features[method]  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] - only Dict
