"""How long an editor waits for the server.

A client types into files of so many elements through the installed command, and asks after each key. What is measured
is the time from the key to the answer, and to the findings without the pause that comes before them. Beside it stands
the time of a check in the same process, so that figures of different machines can be compared by their ratio.
"""

import asyncio
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from time import perf_counter
from typing import Any

from lsprotocol import types

import twinform
from testbed.editor.client import Editor, editor
from testbed.robots import ELEMENTS_PER_LINK, urdf
from twinform.server.session import PAUSE

_TIMES = 15
_MARK = '<parent link="'


def _requests(document: types.TextDocumentIdentifier, where: types.Position) -> Mapping[str, tuple[str, Any]]:
    context = types.ReferenceContext(include_declaration=True)
    return {
        "completion": (types.TEXT_DOCUMENT_COMPLETION, types.CompletionParams(document, where)),
        "hover": (types.TEXT_DOCUMENT_HOVER, types.HoverParams(document, where)),
        "definition": (types.TEXT_DOCUMENT_DEFINITION, types.DefinitionParams(document, where)),
        "references": (types.TEXT_DOCUMENT_REFERENCES, types.ReferenceParams(context, document, where)),
        "rename": (types.TEXT_DOCUMENT_RENAME, types.RenameParams(document, where, "another")),
        "symbols": (types.TEXT_DOCUMENT_DOCUMENT_SYMBOL, types.DocumentSymbolParams(document)),
        "folding": (types.TEXT_DOCUMENT_FOLDING_RANGE, types.FoldingRangeParams(document)),
        "links": (types.TEXT_DOCUMENT_DOCUMENT_LINK, types.DocumentLinkParams(document)),
    }


async def _timed(one: Editor, uri: str, text: str) -> dict[str, list[float]]:
    """The milliseconds of each request, each after a key of its own."""
    start = text.index(_MARK, len(text) // 2) + len(_MARK)
    line = text.count("\n", 0, start)
    where = types.Position(line, start - text.rfind("\n", 0, start) - 1)
    requests = _requests(types.TextDocumentIdentifier(uri), where)
    times: dict[str, list[float]] = {name: [] for name in (*requests, "findings")}
    for _ in range(_TIMES):
        for name, (method, params) in requests.items():
            begin = perf_counter()
            _key(one, uri)
            await one.request(method, params)
            times[name].append(1000 * (perf_counter() - begin))
        begin = perf_counter()
        version = _key(one, uri)
        await one.diagnostics(uri, version)
        times["findings"].append(1000 * (perf_counter() - begin - PAUSE))
    return times


def _key(one: Editor, uri: str) -> int:
    """Type a blank at the beginning, or delete it again, so that each text differs from the one before."""
    there = one.versions[uri] % 2 == 0
    return one.change(uri, ((0, 0, 0, 1), "") if there else ((0, 0, 0, 0), " "))


async def _session(folder: Path, elements: int) -> dict[str, list[float]]:
    text = urdf(elements // ELEMENTS_PER_LINK).removeprefix('<?xml version="1.0"?>\n')
    async with editor(folder) as one:
        uri = one.open(folder / f"robot_{elements}.urdf", text)
        await one.diagnostics(uri)
        times = await _timed(one, uri, text)
    times["check"] = [_milliseconds(lambda: twinform.check(text.encode())) for _ in range(_TIMES)]
    return times


def _milliseconds(call: Callable[[], object]) -> float:
    begin = perf_counter()
    call()
    return 1000 * (perf_counter() - begin)


def measured(sizes: Sequence[int]) -> dict[int, dict[str, list[float]]]:
    """The times of each size."""
    found: dict[int, dict[str, list[float]]] = {}
    for elements in sizes:
        with tempfile.TemporaryDirectory() as folder:
            found[elements] = asyncio.run(_session(Path(folder), elements))
    return found
