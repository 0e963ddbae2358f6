"""A session of the language server in this process: messages in, and what the server says of them."""

import json
from collections import Counter
from collections.abc import Callable, Iterable
from io import BytesIO
from queue import Empty, Queue
from typing import Any, ParamSpec, TypeVar, cast

from twinform.server.serving import talk
from twinform.server.session import TaskError, Worker
from twinform.server.wiring import make_server

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")
Message = dict[str, Any]
HEALTHY = "file:///nowhere/healthy.urdf"
_ENDS = frozenset({"shutdown", "exit"})
"""What may end the session, so that a document that is opened afterwards is not looked at."""
_SECONDS = 60
INITIALIZE: Message = {"processId": None, "rootUri": None, "capabilities": {}}


class _Inline(Worker):
    """Does what a worker does in this process, at once."""

    async def run(self, task: Callable[Arguments, Result], *args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        try:
            return task(*args, **kwargs)
        except Exception as error:
            raise TaskError(repr(error)) from error

    def stop(self) -> None:
        """End nothing."""


class _Editor:
    """The streams of an editor, which answers what it is asked, and goes away once it has all answers."""

    def __init__(self, bodies: Iterable[bytes]) -> None:
        self.said: list[Message] = []
        self.waiting = Counter[str]()
        self.is_healthy = self.is_ended = self.has_left = False
        self._messages: Queue[bytes] = Queue()
        self._rest = BytesIO()
        for body in bodies:
            self._send(body)
            parsed = _parsed(body)
            self.has_left = self.has_left or (parsed.get("method") == "exit" and "id" not in parsed)
            if "method" in parsed and "id" in parsed and _is_id(parsed["id"]):
                self.waiting[json.dumps(parsed["id"])] += 1
            self.is_ended = self.is_ended or parsed.get("method") in _ENDS

    def _send(self, body: bytes) -> None:
        self._messages.put(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))

    def readline(self, most: int) -> bytes:
        return self._rest.readline(most) or self._next().readline(most)

    def read(self, most: int) -> bytes:
        return self._rest.read(most)

    def _next(self) -> BytesIO:
        try:
            self._rest = BytesIO(self._messages.get(timeout=_SECONDS))
        except Empty:
            self._rest = BytesIO()
        return self._rest

    def write(self, data: bytes) -> None:
        message: Message = json.loads(data.partition(b"\r\n\r\n")[2])
        self.said.append(message)
        if "method" not in message:
            self.waiting[json.dumps(message["id"])] -= 1
        elif "id" in message:
            self._send(json.dumps({"jsonrpc": "2.0", "id": message["id"], "result": {"applied": True}}).encode())
        elif message["params"].get("uri") == HEALTHY:
            self.is_healthy = True
        if (self.is_healthy or self.is_ended) and not any(count > 0 for count in self.waiting.values()):
            self._messages.put(b"")

    def flush(self) -> None:
        """Do nothing: all is written."""


def request(id_: object, method: str, params: object) -> bytes:
    """The body of a request."""
    return json.dumps({"jsonrpc": "2.0", "id": id_, "method": method, "params": params}).encode()


def notification(method: str, params: object) -> bytes:
    """The body of a notification."""
    return json.dumps({"jsonrpc": "2.0", "method": method, "params": params}).encode()


def opened(uri: str, text: str) -> bytes:
    """The notification that a document was opened."""
    item = {"uri": uri, "languageId": "urdf", "version": 1, "text": text}
    return notification("textDocument/didOpen", {"textDocument": item})


def play(bodies: Iterable[bytes]) -> list[Message]:
    """What a server says in a session that has begun; each request has one answer, and the last document is checked."""
    begin = (request("begin", "initialize", INITIALIZE), notification("initialized", {}))
    return play_from_the_start((*begin, *bodies))


def play_from_the_start(bodies: Iterable[bytes]) -> list[Message]:
    """What a server says in a session that has not begun, in which nothing is left without an answer."""
    editor = _Editor((*bodies, opened(HEALTHY, '<robot name="r"><link name="a"/><link name="a"/></robot>')))
    talk(make_server(worker=_Inline()), cast("Any", editor), cast("Any", editor))
    asked = {id_: count for id_, count in editor.waiting.items() if count and id_ != "null"}
    assert editor.has_left or not asked, f"requests with none or several answers: {asked}"
    assert editor.has_left or editor.is_ended or editor.is_healthy, "no more documents are checked"
    return editor.said


def _parsed(body: bytes) -> Message:
    try:
        parsed = json.loads(body)
    except (ValueError, RecursionError):
        return {}
    if not isinstance(parsed, dict):
        return {}
    message = cast("Message", parsed)
    # one that does not say its version is refused as a whole, without a look at its id
    return message if message.get("jsonrpc") == "2.0" else {}


def _is_id(value: object) -> bool:
    return isinstance(value, str | int) and not isinstance(value, bool)
