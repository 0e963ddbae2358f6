"""JSON input: from JSON to the text of the format that the document is in, which is read as any other text.

Pydantic validates the JSON, so that a document has no field but those of the IR. The text meets the checks of its
format, and nothing comes in that a file could not say: what does not come back as it was is an error.
"""

import json
import sys
from collections.abc import Iterator, Mapping
from typing import Any, cast

from twinform.compiler.input.documents import first_difference, shown, unwritable_part, without_empty
from twinform.compiler.input.parsing import refuse_excess
from twinform.compiler.input.size_limits import excess_of_names
from twinform.compiler.output.emitting import document_text
from twinform.compiler.output.json import IDENTIFIER, Data, JsonPath, is_array, is_object
from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, LineOrigins, Location, Source, rules
from twinform.diagnostics.did_you_mean import did_you_mean
from twinform.ir import Document, Node, node_values
from twinform.ir.rewrite import classes_in
from twinform.lazy import lazy_pattern

_MOST = 20
"""The faults that are reported: what is of another kind altogether has thousands."""
_AS_THEY_ARE = frozenset({"order", "opaque", "content"})
"""Fields in which no node stands."""
_QUALIFIED = '"{'
"""How a name in a namespace begins."""
_TOKEN = lazy_pattern(r'"(?:[^"\\]|\\.)*"|[{}\[\],:]|[^\s{}\[\],:"]+')
_QUOTED = lazy_pattern("'([^']*)'")
_NO_FIELD = "is no field of this object"
_MESSAGES = {
    "dataclass_type": "is no object",
    "dict_type": "is no object",
    "is_instance_of": _NO_FIELD,  # of a field that only Python has
    "string_pattern_mismatch": "is {}, which XML cannot hold here",
    "string_unicode": "is {}, which XML cannot hold here",
    "tuple_type": "is no array",
    "unexpected_keyword_argument": _NO_FIELD,
}
"""Errors of Pydantic whose own messages are about Python, or as long as a pattern."""


@dataclass(frozen=True, slots=True)
class JsonSource:
    """A JSON text that is a document, what it holds, and the same as a text of its format."""

    json: str
    data: Data
    text: bytes
    format: str

    def compare(self, document: Document, sink: DiagnosticSink) -> None:
        """Report what the document that was read of the text does not have as it is in the JSON."""
        missed = first_difference(self.data, document)
        if missed is not None:
            missed.report(self.format, _location(lines_of(self.json), missed.path), sink)

    def origins(self, document: Document | None, file: str) -> LineOrigins:
        """Where the lines of the text were in the JSON file."""
        lines = lines_of(self.json)
        nodes = _places(document, ()) if document else ()
        return LineOrigins.of((line, Location(file, lines.get(path, 1))) for line, path in nodes)


def read_json(text: bytes, sink: DiagnosticSink) -> JsonSource | None:
    """What a JSON text holds; errors in the notes where it is none, or no document.

    Raises:
        UnreadableError: it has too many namespaces.
    """
    try:
        decoded = text.decode("utf-8-sig")
        data = json.loads(decoded, object_pairs_hook=_object, parse_constant=_refuse, parse_int=_parse_whole_number)
        named = data.get("namespaces") if is_object(data) else None
        refuse_excess(excess_of_names(len(named) if is_array(named) else 0, decoded.count(_QUALIFIED)), sink)
        return _source(decoded, data, sink)
    except json.JSONDecodeError as error:
        _report(sink, f"not JSON: {error.msg} (column {error.colno})", Location(line=error.lineno, column=error.colno))
    except RecursionError:
        _report(sink, "not JSON: it is nested too deep")
    except ValueError as error:
        _report(sink, f"not JSON: {error}")
    return None


def _source(text: str, data: Any, sink: DiagnosticSink) -> JsonSource | None:
    from pydantic import ValidationError  # noqa: PLC0415 - it takes as long to import as a robot to read

    version = data.pop("$schema", IDENTIFIER) if is_object(data) else IDENTIFIER
    if version != IDENTIFIER:
        message = f"$schema: is {shown(version)}; expected {IDENTIFIER!r}"
        sink.report(rules.INVALID_VALUE, message, _location(lines_of(text), ("$schema",)), expected=IDENTIFIER)
        return None
    try:
        document = Document.model_validate(_with_order(data))
    except ValidationError as error:
        lines = lines_of(text)
        for each in error.errors(include_url=False)[:_MOST]:
            _report_fault(each, data, lines, sink)
        return None
    unwritable = unwritable_part(data)
    if unwritable is not None:
        path, message = unwritable
        _report(sink, message, _location(lines_of(text), path))
        return None
    try:
        made = document_text(document)
    except ValueError as error:  # a name that lxml does not take
        _report(sink, f"the document: it cannot be written: {error}")
        return None
    # The writers write the fields that their tables name, so what no file can express would be
    # lost silently. The text is therefore compared with the JSON once it is read.
    return JsonSource(text, without_empty(data), made.encode(), document.format.value)


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


def _parse_whole_number(digits: str) -> int:
    most = sys.get_int_max_str_digits()
    if most and len(digits.lstrip("-")) > most:  # the words of `int` are about Python, not about the file
        raise ValueError(f"a number has more than {most:,} digits")
    return int(digits)


def _report(sink: DiagnosticSink, message: str, where: Location | None = None) -> None:
    sink.report(rules.INVALID_VALUE, message, where or Location(line=1))


def _report_fault(error: Any, data: Any, lines: Mapping[JsonPath, int], sink: DiagnosticSink) -> None:
    """Report an error of Pydantic with the place in the JSON and what may be meant."""
    path, known = _place(error["loc"], data)
    found, context = error["input"], error.get("ctx", {})
    word, words = context.get("tag", found), _QUOTED.findall(context.get("expected_tags", context.get("expected", "")))
    message = _MESSAGES[kind] if (kind := error["type"]) in _MESSAGES else error["msg"]
    if kind == "missing":
        message = f"has no {error['loc'][-1]!r}"
    elif message == _NO_FIELD:
        word, words = error["loc"][-1], known
        message = "is no list of the names of arrays" if word == "order" else message
    sink.report(
        rules.INVALID_VALUE,
        f"{'/'.join(map(str, path)) or 'the document'}: {message.format(shown(found))}",
        _location(lines, path),
        found=None if is_object(found) or is_array(found) else shown(found),
        help=did_you_mean(word, words) if isinstance(word, str) else None,
    )


def _place(steps: JsonPath, data: Any) -> tuple[JsonPath, set[str]]:
    """Where the steps of an error lead in JSON, and the names of the fields that an object there may have.

    Some steps are the kind of a shape, or a field that is missing.
    """
    path: JsonPath = ()
    value, kinds, known = data, {Document}, set[str]()
    for step in steps:
        if isinstance(step, str) and is_object(value) and step in value:
            known = {name for kind in kinds for name in kind.field_names if name != "source"}
            kinds = {each for kind in kinds if step in kind.field_names for each in classes_in(kind, step)}
            value = cast("object", value[step])
        elif isinstance(step, int) and is_array(value) and step < len(value):
            value = cast("object", value[step])
        else:
            continue
        path = (*path, step)
    return path, known


def _location(lines: Mapping[JsonPath, int], path: JsonPath) -> Location:
    """The place of a value, or of the nearest one around it."""
    known = path
    while known and known not in lines:
        known = known[:-1]
    return Location(line=lines.get(known, 1), path="/".join(map(str, path)))


def _with_order(data: Any) -> Any:
    """Return the data with line numbers in place of `order`, since writers sort parts by their lines."""
    if is_array(data):
        return list(map(_with_order, data))
    if not is_object(data):
        return data
    made = {name: value if name in _AS_THEY_ARE else _with_order(value) for name, value in data.items()}
    order = made.get("order")
    if not (is_array(order) and all(isinstance(each, str) for each in order)):
        return made
    del made["order"]
    lists = {name: iter(part if is_array(part := made.get(name)) else ()) for name in order}
    for rank, name in enumerate(order, 1):
        part = next(lists[name], None)
        if is_object(part):
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
