"""A session of an editor with the installed command: each request and its answer.

The requests are in `session/requests.toml`. Where `answers.json` is deleted, the first run writes it again.
"""

import asyncio
import json
import shutil
import tomllib
from pathlib import Path
from typing import Any, cast

import pytest
from lsprotocol import types
from lsprotocol.converters import get_converter
from pygls.exceptions import JsonRpcException

from testbed.editor.client import Editor, editor

SESSION = Path(__file__).with_name("session")
ANSWERS = SESSION / "answers.json"
REQUESTS: list[dict[str, str]] = tomllib.loads((SESSION / "requests.toml").read_text(encoding="utf-8"))["request"]
METHODS = {
    "hover": types.TEXT_DOCUMENT_HOVER,
    "completion": types.TEXT_DOCUMENT_COMPLETION,
    "definition": types.TEXT_DOCUMENT_DEFINITION,
    "references": types.TEXT_DOCUMENT_REFERENCES,
    "highlight": types.TEXT_DOCUMENT_DOCUMENT_HIGHLIGHT,
    "prepare": types.TEXT_DOCUMENT_PREPARE_RENAME,
    "rename": types.TEXT_DOCUMENT_RENAME,
    "symbols": types.TEXT_DOCUMENT_DOCUMENT_SYMBOL,
    "workspace": types.WORKSPACE_SYMBOL,
    "folding": types.TEXT_DOCUMENT_FOLDING_RANGE,
    "links": types.TEXT_DOCUMENT_DOCUMENT_LINK,
    "format": types.TEXT_DOCUMENT_FORMATTING,
    "actions": types.TEXT_DOCUMENT_CODE_ACTION,
    "passes": types.WORKSPACE_EXECUTE_COMMAND,
}
AT_PLACES = {
    "hover": types.HoverParams,
    "completion": types.CompletionParams,
    "definition": types.DefinitionParams,
    "highlight": types.DocumentHighlightParams,
    "prepare": types.PrepareRenameParams,
}
_LEFT_OUT = frozenset({"sortText", "filterText", "insertTextFormat", "kind", "tooltip"})


def position(text: str, at: str) -> types.Position:
    before, _, after = at.partition("|")
    assert text.count(before + after) >= 1, at
    start = text.index(before + after) + len(before)
    return types.Position(text.count("\n", 0, start), start - text.rfind("\n", 0, start) - 1)


def params(request: dict[str, str], folder: Path) -> Any:
    if request["method"] == "workspace":
        return types.WorkspaceSymbolParams(request["at"])
    path = folder / request["file"]
    document = types.TextDocumentIdentifier(path.as_uri())
    if request["method"] == "passes":
        return types.ExecuteCommandParams("twinform.runPasses", [path.as_uri(), request["new"]])
    if request["method"] == "format":
        return types.DocumentFormattingParams(document, types.FormattingOptions(2, insert_spaces=True))
    whole = {
        "symbols": types.DocumentSymbolParams,
        "folding": types.FoldingRangeParams,
        "links": types.DocumentLinkParams,
    }
    if request["method"] in whole:
        return whole[request["method"]](document)
    where = position(path.read_text(encoding="utf-8"), request["at"])
    match request["method"]:
        case "references":
            return types.ReferenceParams(types.ReferenceContext(include_declaration=True), document, where)
        case "rename":
            return types.RenameParams(document, where, request["new"])
        case "actions":
            return types.CodeActionParams(document, types.Range(where, where), types.CodeActionContext([]))
        case _:
            return AT_PLACES[request["method"]](document, where)


def shown(value: Any, folder: str) -> Any:
    """An answer as the file has it: without what is empty, and ranges as texts."""
    if isinstance(value, dict):
        value = cast("dict[str, Any]", value)
        if set(value) == {"start", "end"}:
            start, end = value["start"], value["end"]
            return f"{start['line']}:{start['character']}-{end['line']}:{end['character']}"
        named = {key.replace(folder, ""): shown(one, folder) for key, one in value.items() if key not in _LEFT_OUT}
        return {key: one for key, one in named.items() if one not in (None, [], {})}
    if isinstance(value, list):
        return [shown(one, folder) for one in cast("list[Any]", value)]
    return value.replace(folder, "").replace(folder.removeprefix("file://"), "") if isinstance(value, str) else value


def choices(found: types.CompletionList) -> list[str]:
    """Proposals in the order in which an editor shows them, and what they make of which range."""
    listed: list[str] = []
    for each in sorted(found.items, key=lambda each: each.sort_text or ""):
        assert isinstance(each.text_edit, types.TextEdit)
        where = shown(get_converter().unstructure(each.text_edit.range), "")
        listed.append(f"{each.label}: {each.text_edit.new_text!r} at {where}")
    return listed


async def answer(one: Editor, request: dict[str, str], folder: Path) -> Any:
    converter = get_converter()
    try:
        found = await one.request(METHODS[request["method"]], params(request, folder))
    except JsonRpcException as error:
        return {"error": error.message}
    if request["method"] == "completion":
        return choices(found)
    if request["method"] == "passes":
        assert one.edits, one.messages
        found = one.edits.pop().edit
    return shown(converter.unstructure(found), f"{folder.as_uri()}/")


async def session(folder: Path) -> list[dict[str, Any]]:
    async with editor(folder) as one:
        for path in sorted(folder.glob("*.*")):
            one.open(path)
        await one.diagnostics((folder / "arm.urdf").as_uri())
        return [{"request": each, "answer": await answer(one, each, folder)} for each in REQUESTS]


@pytest.mark.slow
def test_every_request_of_a_session_has_its_answer(tmp_path: Path) -> None:
    shutil.copytree(SESSION, tmp_path, dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.toml", "*.json"))
    found = json.loads(json.dumps(asyncio.run(session(tmp_path))))
    assert len(found) >= 30
    if not ANSWERS.exists():
        ANSWERS.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
        pytest.fail(f"{ANSWERS.name} was written: read it, and run the test again")
    for one, expected in zip(found, json.loads(ANSWERS.read_text(encoding="utf-8")), strict=True):
        assert one == expected
