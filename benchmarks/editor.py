"""How long an editor waits: `python -m benchmarks.editor [FILE] [--elements N]...`; FILE is the page to write.

A client types into files of so many elements through the installed command, and asks after each key. What is measured
is the time from the key to the answer, and to the findings without the pause that comes before them. Beside it stands
the time of a check in the same process, so that figures of different machines can be compared by their ratio.
"""

import argparse
import asyncio
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

from lsprotocol import types

import twinform
from benchmarks.robots import ELEMENTS_PER_LINK, urdf
from reports.harness.pages import paragraphs, table
from tests.unit.server.client import Editor, editor
from twinform.server.scheduling import PAUSE

ELEMENTS = (200, 2_000, 20_000)
TARGET = 100.0
"""Milliseconds for a key in a file of 2,000 elements."""
_HELD_TO = 2_000
_TIMES = 15
_NO_ANSWERS = frozenset({"findings", "check"})
_MARK = '<parent link="'
_ABOUT = """\
Milliseconds between a key and the answer, through a client on standard input and output: the median and, behind it, the
longest of so many keys, each of which makes the whole text another one. *Findings* is what comes on top of the pause of
150 ms after the last key. *check* is `twinform.check` of the same text in one process, without an editor."""


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


def page(found: Mapping[int, Mapping[str, list[float]]]) -> str:
    """The page with the table."""
    head = ["elements", *next(iter(found.values()))]
    rows = [
        [f"{elements:,}", *(f"{median(each):.0f} ({max(each):.0f})" for each in times.values())]
        for elements, times in found.items()
    ]
    return paragraphs("# An editor at work", "Made by `make latency`.", _ABOUT, table(head, rows)) + "\n"


def main(arguments: Sequence[str]) -> int:
    """Measure, and print the page or write it; 1 where a key takes too long."""
    parser = argparse.ArgumentParser()
    parser.add_argument("file", type=Path, nargs="?")
    parser.add_argument("--elements", type=int, action="append")
    given = parser.parse_args(arguments)
    found = measured(given.elements or ELEMENTS)
    text = page(found)
    print(text)
    if given.file:
        given.file.write_text(text, encoding="utf-8")
    answers = found.get(_HELD_TO, {}).items()
    slow = [name for name, each in answers if name not in _NO_ANSWERS and median(each) > TARGET]
    if slow:
        print(f"more than {TARGET:g} ms for a key in a file of {_HELD_TO:,} elements: {', '.join(slow)}")
    return 1 if slow else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
