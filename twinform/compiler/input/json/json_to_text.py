"""From JSON to the text of the format that it is in, which is then read as any other text.

So JSON meets the same checks, and nothing comes in by it that a file of its format could not say: what does not come
back as it was is an error.
"""

import json
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from twinform.compiler.input.json.comparing import MOST, differences, plain, report_missed
from twinform.compiler.input.parsing import refuse_excess
from twinform.compiler.input.size_limits import excess_of_names
from twinform.compiler.output.emitting import document_text
from twinform.compiler.output.json import Data, json_data
from twinform.diagnostics import DiagnosticSink, LineOrigins, Location, Source, rules
from twinform.ir import Document, Node, node_values
from twinform.schemas.json_check import JsonPath, is_array, is_object, json_faults

_QUALIFIED = '"{'
"""How a name in a namespace begins."""


@dataclass(frozen=True, slots=True)
class JsonSource:
    """A JSON text that fits its schema, what it holds, and the same as a text of its format."""

    json: str
    data: Data
    text: bytes
    format: str

    def compare(self, document: Document, sink: DiagnosticSink) -> None:
        """Report what the document that was read of the text does not have as it is in the JSON."""
        missed = next(differences(self.data, plain(json_data(document)), ()), None)
        if missed is not None:
            report_missed(missed, self.format, _location(lines_of(self.json), missed.path), sink)

    def origins(self, document: Document | None, file: str) -> LineOrigins:
        """Where the lines of the text were in the JSON file."""
        lines = lines_of(self.json)
        nodes = _places(document, ()) if document else ()
        return LineOrigins.of((line, Location(file, lines.get(path, 1))) for line, path in nodes)


def read_json(text: bytes, sink: DiagnosticSink) -> JsonSource | None:
    """What a JSON text holds; errors in the notes where it is none, or does not fit the schema.

    Raises:
        UnreadableError: it has too many namespaces.
    """
    try:
        decoded = text.decode("utf-8-sig")
        data = json.loads(decoded, object_pairs_hook=_object, parse_constant=_refuse, parse_int=_whole)
    except json.JSONDecodeError as error:
        _report(sink, f"not JSON: {error.msg} (column {error.colno})", Location(line=error.lineno, column=error.colno))
        return None
    except (ValueError, RecursionError) as error:
        _report(sink, f"not JSON: {'it is nested too deep' if isinstance(error, RecursionError) else error}")
        return None
    named = data.get("namespaces") if is_object(data) else None
    refuse_excess(excess_of_names(len(named) if is_array(named) else 0, decoded.count(_QUALIFIED)), sink)
    faults = list(json_faults(data))
    if faults:
        lines = lines_of(decoded)
        for fault in faults[:MOST]:
            message = f"{'/'.join(map(str, fault.path)) or 'the document'}: {fault.message}"
            where, rule = _location(lines, fault.path), rules.INVALID_VALUE
            sink.report(rule, message, where, found=fault.found, expected=fault.expected, help=fault.help)
        return None
    values = plain(data)
    document = Document.model_validate(_with_order({key: values[key] for key in values if key != "$schema"}))
    try:
        # The writers write the fields that their tables name, so what no file can express would be
        # lost silently. JSON therefore becomes text, which is read as any other, and then compared
        # with the JSON (`comparing.py`).
        made = document_text(document)
    except ValueError as error:  # a name that lxml does not take
        _report(sink, f"the document: it cannot be written: {error}")
        return None
    return JsonSource(decoded, values, made.encode(), document.format.value)


def _object(pairs: list[tuple[str, Any]]) -> Data:
    """An object of JSON.

    Raises:
        ValueError: it has a name twice, of which readers of JSON would see the last alone.
    """
    made = dict(pairs)
    if len(made) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"an object has the field {twice!r} twice")
    return made


def _refuse(word: str) -> object:
    raise ValueError(f'{word} is no number of JSON; SDF may have the word "{word}" in quotes')


def _whole(digits: str) -> int:
    most = sys.get_int_max_str_digits()
    if most and len(digits.lstrip("-")) > most:  # the words of `int` are about Python, not about the file
        raise ValueError(f"a number has more than {most:,} digits")
    return int(digits)


def _report(sink: DiagnosticSink, message: str, where: Location | None = None) -> None:
    sink.report(rules.INVALID_VALUE, message, where or Location(line=1))


def _location(lines: dict[JsonPath, int], path: JsonPath) -> Location:
    """The place of a value, or of the nearest one around it."""
    known = path
    while known and known not in lines:
        known = known[:-1]
    return Location(line=lines.get(known, 1), path="/".join(map(str, path)))


def _with_order(data: Any) -> Any:
    """Return the data with line numbers in place of `order`, since writers sort parts by their lines."""
    if is_array(data):
        return [_with_order(each) for each in data]
    if not is_object(data):
        return data
    made: Data = {
        name: _with_order(value) for name, value in data.items() if name not in {"order", "opaque", "content"}
    }
    made |= {name: data[name] for name in ("opaque", "content") if name in data}
    lists = {name: iter(made.get(name, ())) for name in data.get("order", ())}
    for rank, name in enumerate(data.get("order", ()), 1):
        part: Data | None = next(lists[name], None)
        if part is not None:
            part["source"] = Source("", rank, None, "")
    return made


def _places(node: Node, path: JsonPath) -> Iterator[tuple[int, JsonPath]]:
    """The lines of a document's nodes, and where JSON has them."""
    if node.source is not None:
        yield node.source.line, path
    for name, value in node_values(node):
        if isinstance(value, Node):
            yield from _places(value, (*path, name))
        else:
            for index, child in enumerate(value):
                yield from _places(child, (*path, name, index))


_TOKEN = re.compile(r'"(?:[^"\\]|\\.)*"|[{}\[\],:]|[^\s{}\[\],:"]+')


def lines_of(text: str) -> dict[JsonPath, int]:
    """The line of every value of a JSON text, by the names and places that lead to it."""
    found: dict[JsonPath, int] = {}
    path: list[str | int] = []
    line, seen, names = 1, 0, False
    for token in _TOKEN.finditer(text):
        line, seen, word = line + text.count("\n", seen, token.start()), token.start(), token[0]
        match word:
            case "}" | "]":
                path.pop()
                names = False
            case ":":
                names = False
            case "," if isinstance(path[-1], int):
                path[-1] += 1
            case ",":
                names = True
            case _ if names:
                path[-1] = json.loads(word)
            case _:
                found[tuple(path)] = line
                names = word == "{"
                if word in "{[":
                    path.append("" if names else 0)
    return found
