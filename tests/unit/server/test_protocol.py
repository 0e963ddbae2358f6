"""Messages that nobody expects: each request has exactly one answer, and documents are checked afterwards."""

import json
import re
from pkgutil import resolve_name
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from testbed.editor.playing import (
    HEALTHY,
    INITIALIZE,
    Message,
    notification,
    opened,
    play,
    play_from_the_start,
    request,
)

ROBOT = '<robot name="r"><link name="a"/><joint name="j" type="fixd"><parent link="a"/></joint></robot>'
SYMBOLS = ("workspace/symbol", {"query": ""})
URIS = [
    "file:///nowhere/robot.urdf",
    "file:///nowhere/a%00b.urdf",
    "file:///nowhere/\ud800.urdf",
    "file:///nowhere/%ff.urdf",
    "file:///nowhere/%ed%a0%80.xacro",
    "file:///nowhere/../../etc/passwd",
    "file:///" + "a" * 5_000 + ".urdf",
    "file://host/share/robot.urdf",
    "file:///dev/stdin",
    "file:///proc/self/mem",
    "file:///",
    "file:",
    "http://[robot.urdf",
    "untitled:Untitled-1",
    "vscode-remote://ssh+host/home/robot.sdf",
    "x:/..",
    "",
]
HOVER = {"textDocument": {"uri": URIS[0]}, "position": {"line": 0, "character": 3}}


def error_of(said: list[Message], id_: object = 1) -> int:
    (found,) = [each for each in said if "method" not in each and each["id"] == id_]
    return found["error"]["code"]


@pytest.mark.parametrize("uri", URIS, ids=lambda uri: ascii(uri[:40]))
def test_no_uri_stops_the_diagnostics_of_other_documents(uri: str) -> None:
    document = {"textDocument": {"uri": uri}}
    said = play(
        [
            opened(uri, ROBOT),
            request(1, "textDocument/hover", document | {"position": {"line": 0, "character": 12}}),
            request(2, "textDocument/formatting", document | {"options": {"tabSize": 2, "insertSpaces": True}}),
            request(3, "textDocument/references", HOVER | document | {"context": {"includeDeclaration": True}}),
        ]
    )
    assert not [each for each in said if "error" in each]
    assert {each["params"]["uri"] for each in said if each.get("method") == "textDocument/publishDiagnostics"} >= {uri}


@pytest.mark.parametrize(
    ("code", "id_", "body"),
    [
        (-32700, None, b"{nonsense"),
        (-32700, None, b'"\xff'),
        (-32700, None, b"[" * 100_000),
        (-32700, None, b'{"jsonrpc": "2.0", "id": 1, "method": "shutdown", "params": %s}' % (b"9" * 5_000)),
        (-32700, None, b'{"jsonrpc": "2.0", "id": NaN, "method": "shutdown"}'),
        (-32600, None, b"[%s]" % request(1, *SYMBOLS)),
        (-32600, None, b"3"),
        (-32600, None, b"{}"),
        (-32600, None, request(None, *SYMBOLS)),
        (-32600, None, request([1], *SYMBOLS)),
        (-32600, None, request(1.5, *SYMBOLS)),
        (-32600, None, request(True, *SYMBOLS)),
        (-32600, 1, b'{"jsonrpc": "2.0", "id": 1, "method": 3}'),
        (-32600, 1, request(1, "textDocument/didOpen", {})),
        (-32600, 1, request(1, "exit", None)),
        (-32600, 1, request(1, "initialize", INITIALIZE)),
        (-32601, 1, request(1, "nonsense/x", {"a": 1})),
        (-32601, 1, request(1, "$/nonsense", {"a": 1})),
        (-32602, 1, b'{"jsonrpc": "2.0", "id": 1, "method": "textDocument/hover"}'),
        (-32602, 1, request(1, "textDocument/hover", {"textDocument": 3, "position": []})),
        (-32602, 1, request(1, "textDocument/hover", HOVER | {"position": {"line": -1, "character": 2**63}})),
        (-32602, 1, request(1, "textDocument/hover", HOVER | {"position": {"line": 1e999, "character": "x"}})),
        (-32602, 1, request(1, "workspace/executeCommand", {"command": "nonsense"})),
        (-32602, 1, request(1, "workspace/executeCommand", {"command": "twinform.runPasses"})),
        (-32602, 1, request(1, "workspace/executeCommand", {"command": "twinform.runPasses", "arguments": [1, "x"]})),
    ],
    ids=lambda value: ascii(value[:60]) if isinstance(value, bytes) else None,
)
def test_a_malformed_request_has_the_error_of_the_protocol(code: int, id_: object, body: bytes) -> None:
    # `Infinity` is what Python makes of 1e999
    assert error_of(play([body.replace(b"Infinity", b"1e999")]), id_) == code


def test_requests_before_initialize_and_after_shutdown_have_their_errors() -> None:
    said = play_from_the_start(
        [
            request(1, *SYMBOLS),
            opened(URIS[0], ROBOT),
            request(2, "initialize", INITIALIZE),
            request(3, *SYMBOLS),
            request(4, "shutdown", None),
            request(5, *SYMBOLS),
            notification("exit", None),
        ]
    )
    assert (error_of(said, 1), error_of(said, 5)) == (-32002, -32600)
    assert [each["result"] for each in said if each.get("id") == 3] == [[]]


@pytest.mark.parametrize(
    "body",
    [
        notification("$/cancelRequest", {"id": [1]}),
        notification("$/cancelRequest", None),
        notification("textDocument/didOpen", {"textDocument": {"uri": 3}}),
        notification("nonsense", None),
        b'{"jsonrpc": "2.0", "id": [1], "result": 1}',
        b'{"jsonrpc": "2.0", "id": "nobody has asked", "error": {}}',
    ],
)
def test_a_notification_that_cannot_be_used_is_in_the_log(body: bytes) -> None:
    logged = [each for each in play([body]) if each.get("method") == "window/logMessage"]
    assert [each["params"]["message"] for each in logged if "ignored" in each["params"]["message"]]


@pytest.mark.parametrize("function", ["twinform.server.checking.inspect", "twinform.server.session.Session.job"])
def test_an_exception_in_a_check_is_said_and_other_documents_are_checked(
    function: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    original = resolve_name(function)

    def broken(*args: Any) -> Any:
        if "robot.urdf" in repr(args):
            raise ZeroDivisionError("of the test")
        return original(*args)

    monkeypatch.setattr(function, broken)
    said = play([opened(URIS[0], ROBOT)])
    (found,) = [
        each["params"]["diagnostics"]
        for each in said
        if each.get("method") == "textDocument/publishDiagnostics" and each["params"]["uri"] == URIS[0]
    ]
    assert ["of the test" in each["message"] for each in found] == [True]


def test_a_hover_quotes_a_file_as_code() -> None:
    link = '<link name="a" x="\n```\n![x](https://x/x.png)"/>'
    text = f'<robot name="r">{link}<joint name="j"><child link="a"/></joint></robot>'
    position = {"line": 2, "character": text.split("\n")[2].index('link="a"') + 6}
    said = play([opened(URIS[0], text), request(1, "textDocument/hover", HOVER | {"position": position})])
    (value,) = [each["result"]["contents"]["value"] for each in said if each.get("id") == 1]
    assert "````xml\n<link" in value


_NUMBERS: st.SearchStrategy[Any] = st.sampled_from([0, 1, 2, 60, -1, 2**31, 2**63, 1.5, None, "1"])
_PLACES: st.SearchStrategy[Any] = st.fixed_dictionaries({}, optional={"line": _NUMBERS, "character": _NUMBERS})
_RANGES: st.SearchStrategy[Any] = st.fixed_dictionaries({"start": _PLACES, "end": _PLACES})
_TEXTS: st.SearchStrategy[Any] = st.sampled_from(
    [ROBOT, ROBOT[:50], "", "\0", "<", "\ud800", '<sdf version="1.9"/>', '<robot name="${a}">']
)
_DOCUMENTS: st.SearchStrategy[Any] = st.fixed_dictionaries(
    {"uri": st.sampled_from([*URIS, HEALTHY, None])},
    optional={"version": _NUMBERS, "text": _TEXTS, "languageId": _TEXTS},
)
_CHANGES: st.SearchStrategy[Any] = st.lists(
    st.fixed_dictionaries({"text": _TEXTS}, optional={"range": _RANGES}), max_size=3
)
_PARAMS: st.SearchStrategy[Any] = st.fixed_dictionaries(
    {"textDocument": _DOCUMENTS},
    optional={
        "position": _PLACES,
        "range": _RANGES,
        "contentChanges": _CHANGES,
        "context": st.sampled_from([{"includeDeclaration": True}, {"diagnostics": []}, None]),
        "newName": st.sampled_from(["b", "", "<", "../x"]),
        "query": _TEXTS,
        "options": st.sampled_from([{"tabSize": 2, "insertSpaces": True}, {}]),
        "command": st.just("twinform.runPasses"),
        "arguments": st.lists(st.sampled_from([*URIS[:2], "fill-inertia", "nonsense{", 3]), max_size=3),
        "id": st.integers(0, 9) | st.none(),
        "event": st.just({"added": [{"uri": URIS[0], "name": ""}], "removed": [{"uri": URIS[1], "name": ""}]}),
    },
)
_OF_DOCUMENTS = """hover completion definition references documentHighlight prepareRename rename documentSymbol
foldingRange documentLink codeAction formatting didOpen didChange didClose"""
_METHODS: st.SearchStrategy[Any] = st.sampled_from(
    [
        *(f"textDocument/{name}" for name in re.findall(r"\w+", _OF_DOCUMENTS)),
        *("workspace/symbol", "workspace/executeCommand", "workspace/didChangeWorkspaceFolders"),
        *("notebookDocument/didOpen", "initialize", "initialized", "$/cancelRequest", "$/setTrace", "nonsense"),
    ]
)


@st.composite
def bodies(draw: st.DrawFn) -> list[bytes]:
    """Messages that are right, nearly right, or nonsense; each id is used once."""
    made: list[bytes] = []
    for number, (method, params) in enumerate(draw(st.lists(st.tuples(_METHODS, _PARAMS | st.none()), max_size=12))):
        message: dict[str, Any] = {"jsonrpc": "2.0", "method": method, "params": params}
        if draw(st.booleans()):
            message["id"] = number
        made.append(json.dumps(message).encode())
    return made


@given(bodies())
def test_each_request_has_one_answer_whatever_is_sent(messages: list[bytes]) -> None:
    closed = notification("textDocument/didClose", {"textDocument": {"uri": HEALTHY}})
    play([*messages, closed])
