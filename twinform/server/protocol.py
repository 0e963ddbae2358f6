"""The protocol of pygls, made to answer unexpected messages as JSON-RPC and the language server protocol require.

pygls does not answer requests with wrong parameters, before `initialize` or after `shutdown`. Here every request has
one answer; a notification that cannot be used is reported in the log of the editor. Documents are kept by our own
session: pygls walks through all lines of a text for each key, and takes more characters for line ends than the protocol
has.
"""

# pygls has no types for what it keeps:
# pyright: reportUnknownMemberType=false, reportUnknownVariableType=false

import json
from collections.abc import Generator
from typing import Any, NoReturn, cast

import attrs
from cattrs import transform_error
from lsprotocol import types
from pygls.exceptions import (
    JsonRpcException,
    JsonRpcInvalidParams,
    JsonRpcInvalidRequest,
    JsonRpcMethodNotFound,
    JsonRpcParseError,
    JsonRpcServerNotInitialized,
)
from pygls.protocol import LanguageServerProtocol
from pygls.protocol.json_rpc import RPCMessage
from pygls.protocol.language_server import lsp_method

Message = dict[str, Any]
_LONGEST = 500
# Handlers of pygls that are removed, since it would keep documents of its own, and notebooks that nobody reads.
_REMOVED = (
    types.TEXT_DOCUMENT_DID_OPEN,
    types.TEXT_DOCUMENT_DID_CHANGE,
    types.TEXT_DOCUMENT_DID_CLOSE,
    types.NOTEBOOK_DOCUMENT_DID_OPEN,
    types.NOTEBOOK_DOCUMENT_DID_CHANGE,
    types.NOTEBOOK_DOCUMENT_DID_CLOSE,
)


class Protocol(LanguageServerProtocol):
    """Answers messages, and leaves documents to our handlers."""

    def __init__(self, *args: Any) -> None:
        super().__init__(*args)
        self.exit_code: int | None = None
        """The exit code of the process; None until the editor sends `exit`."""
        for method in _REMOVED:
            del self.fm.builtin_features[method]

    def receive(self, data: bytes | None) -> None:
        """Handle a message, and answer it if it is a request; None stands for bytes that are no message."""
        try:
            message = _parsed(data)
            id_ = _id_of(message)
        except JsonRpcException as error:
            self._send_data({"jsonrpc": "2.0", "id": None, "error": error.to_response_error()})
            return
        if "method" not in message:
            self._take_response(message)
            return
        try:
            self._check_state(message["method"], is_request=id_ is not None)
            structured = self._structured(message)
        except JsonRpcException as error:
            if id_ is None:
                self.log(f"{_shown(message['method'])} was ignored: {error.message}")
            else:
                self._send_response(id_, error=error.to_response_error())
        else:
            self.handle_message(structured)

    def log(self, message: str) -> None:
        """Write a message into the log of the editor."""
        self.notify(types.WINDOW_LOG_MESSAGE, types.LogMessageParams(types.MessageType.Warning, message[:_LONGEST]))

    @lsp_method(types.SHUTDOWN)
    def lsp_shutdown(self, *args: Any) -> Generator[Any, Any, None]:
        """Shut down the session, and cancel the requests that are not answered yet."""
        yield self.fm.features[types.SHUTDOWN], args, None
        self._shutdown = True
        # a copy, since a cancelled request is answered and removed at once
        for id_, future in list(self._request_futures.items()):
            if id_ != self.msg_id:
                future.cancel()

    @lsp_method(types.EXIT)
    def lsp_exit(self, *_: object) -> Generator[Any, Any, None]:
        """End the process; without a `shutdown` before, this is an error."""
        self.exit_code = 0 if self._shutdown else 1
        yield from ()

    @lsp_method(types.WORKSPACE_EXECUTE_COMMAND)
    async def lsp_workspace__execute_command(  # pyright: ignore[reportIncompatibleMethodOverride] - pygls takes both kinds
        self, params: types.ExecuteCommandParams
    ) -> Any:
        """Run a command, and return its result."""
        handler = self.fm.commands.get(params.command)
        if handler is None:
            raise JsonRpcInvalidParams(f"there is no command {params.command!r}"[:_LONGEST])
        # awaited here, so that it ends when the request is cancelled: pygls lets it go on and change the document
        return await handler(*(params.arguments or ()))

    def _check_state(self, method: object, *, is_request: bool) -> None:
        """Refuse messages before the session has begun or after it was shut down."""
        if method == types.EXIT and not is_request:
            return
        if self._shutdown:
            raise JsonRpcInvalidRequest("the session was shut down: only 'exit' may follow")
        if self._workspace is None and method != types.INITIALIZE:
            raise JsonRpcServerNotInitialized("the session has not begun: send 'initialize' first")
        if self._workspace is not None and method == types.INITIALIZE:
            raise JsonRpcInvalidRequest("the session has begun already: 'initialize' is sent once")

    def _structured(self, message: Message) -> Any:
        """Convert a request or notification to an object of lsprotocol."""
        method: object = message["method"]
        if not isinstance(method, str):
            raise JsonRpcInvalidRequest("'method' is not a text")
        if method == types.CANCEL_REQUEST:  # pygls has no handler for it, and fails with an id of another type
            _require_request_id(message.get("params"))
        else:
            self._get_handler(method)
        kind = self.get_message_type(method)
        if kind is None:
            raise JsonRpcMethodNotFound.of(method)
        if ("id" in message) != ("id" in attrs.fields_dict(kind)):
            raise JsonRpcInvalidRequest(f"{method} is a {'notification' if 'id' in message else 'request'}")
        try:
            return self._converter.structure(message, kind)
        except Exception as error:
            raise JsonRpcInvalidParams(_reasons(error)) from error

    def _take_response(self, message: Message) -> None:
        """Pass an answer to our request that waits for it."""
        id_ = message.get("id")
        kind = self._result_types.pop(id_, None) if isinstance(id_, str) else None
        if not isinstance(id_, str) or kind is None or self._shutdown:
            self.log("an answer was ignored: nobody has asked for it")
            return
        try:
            structured = self._converter.structure(message, types.ResponseErrorMessage if "error" in message else kind)
        except Exception as error:  # noqa: BLE001 - whoever waits for the answer has to go on
            self._handle_response(id_, error=JsonRpcInvalidParams(_reasons(error)).to_response_error())
        else:
            self.handle_message(cast("RPCMessage", structured))


def _parsed(data: bytes | None) -> Message:
    if data is None:
        raise JsonRpcParseError("this is no message: write 'Content-Length: ', the length in bytes, and an empty line")
    try:
        # Python's parser takes NaN and Infinity, which JSON does not have.
        message = json.loads(data, parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        raise JsonRpcParseError(f"this is no JSON: {error}"[:_LONGEST]) from error
    if not isinstance(message, dict):
        raise JsonRpcInvalidRequest("a message is one object: the language server protocol has no batches")
    message = cast("Message", message)
    if message.get("jsonrpc") != "2.0":
        raise JsonRpcInvalidRequest("""a message says "jsonrpc": "2.0\"""")
    return message


def _id_of(message: Message) -> str | int | None:
    """Return the id of a request or an answer, or None; the answer to an unreadable request has none."""
    id_ = message.get("id")
    # `True` is an int in Python.
    is_allowed = isinstance(id_, str | int) and not isinstance(id_, bool)
    if not is_allowed and "id" in message and "method" in message:
        raise JsonRpcInvalidRequest("the id of a request is a text or an integer")
    return id_ if is_allowed else None


def _require_request_id(params: object) -> None:
    id_ = cast("Message", params).get("id") if isinstance(params, dict) else None
    if not isinstance(id_, str | int):
        raise JsonRpcInvalidParams("'id' is that of a request: a text or an integer")


def _refuse_constant(word: str) -> NoReturn:
    raise ValueError(f"{word} is no number of JSON")


def _reasons(error: Exception) -> str:
    """Say what is wrong with parameters."""
    try:
        return "; ".join(transform_error(error))[:_LONGEST]
    except Exception:  # noqa: BLE001 - cattrs does not know every error, and some are too deep
        return repr(error)[:_LONGEST]


def _shown(method: object) -> str:
    return repr(method)[:_LONGEST]
