"""Compares a JSON document with what its text is read as: what the format cannot express is an error."""

import json
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import Any, NamedTuple, cast

from twinform.compiler.output.json import Data, json_data
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.ir import Document, Node
from twinform.ir.record import field_value
from twinform.schemas.json_check import JsonPath, is_array, is_object, json_faults

MOST = 20
"""The faults that are reported: what is of another kind altogether has thousands."""
_ASIDE = frozenset({"$schema", "namespaces", "order", "spelling"})
"""What is not compared: the version of the schema; prefixes, of which there may be more than were declared; and what
is not about the robot."""
_UNKNOWN = object()


class Missed(NamedTuple):
    """A place where a document differs from the text that was made of it."""

    path: JsonPath
    mine: Any
    theirs: Any


def compare_documents(document: Document, again: Document | None, sink: DiagnosticSink) -> None:
    """Report what of a document its format cannot express: `again` is what its text would be read as, if it has any."""
    data = plain(json_data(document))
    for fault in islice(json_faults(data), MOST):
        name = "/".join(map(str, fault.path))
        message = f"{name or 'the document'}: {fault.message}; {document.format.upper()} cannot express it"
        where = _nearest(document, fault.path).location
        sink.report(rules.INVALID_VALUE, message, where, found=fault.found, expected=fault.expected)
    if again is None or sink.has_errors:
        return
    missed = next(differences(data, plain(json_data(again)), ()), None)
    if missed is not None:
        report_missed(missed, document.format, _nearest(document, missed.path).location, sink)


def _nearest(node: Node, path: JsonPath) -> Node:
    """The innermost node on the way of a path that knows where it was written, or the outermost one."""
    values: Any = node
    for step in path:
        if isinstance(values, Node):
            values = field_value(values, str(step))
        elif isinstance(values, tuple) and isinstance(step, int):
            values = cast("tuple[object, ...]", values)[step]
        else:
            break
        node = values if isinstance(values, Node) and values.source is not None else node
    return node


def report_missed(missed: Missed, format_: str, where: Location, sink: DiagnosticSink) -> None:
    """Report that a document cannot be expressed as it is."""
    name = "/".join(map(str, missed.path))
    became = "leaves it out" if missed.theirs is _UNKNOWN else f"has {_shown(missed.theirs)} there"
    shown = "nothing" if missed.mine is _UNKNOWN else _shown(missed.mine)
    message = f"{name}: {format_.upper()} cannot express {shown}; a file in that format {became}"
    hint = "if it stands in 'opaque', write it in the field that is meant for it"
    sink.report(rules.INVALID_VALUE, message, where, found=shown, help=hint)


def plain(data: Any) -> Any:
    """Return the data without empty objects and arrays."""
    if is_array(data):
        return [plain(each) for each in data]
    if not is_object(data):
        return data
    inner = {name: plain(value) for name, value in data.items()}
    return {name: value for name, value in inner.items() if value not in ({}, [])}


def differences(mine: Any, theirs: Any, path: JsonPath) -> Iterator[Missed]:
    """The places where two documents differ."""
    if is_object(mine) and is_object(theirs):
        for name in [*mine, *(name for name in theirs if name not in mine)]:
            if name == "opaque":
                one, other = (_parts(each.get(name, ())) for each in (mine, theirs))
                if one != other:
                    yield Missed((*path, name), mine.get(name, _UNKNOWN), theirs.get(name, _UNKNOWN))
            elif name not in _ASIDE:
                yield from differences(mine.get(name, _UNKNOWN), theirs.get(name, _UNKNOWN), (*path, name))
    elif is_array(mine) and is_array(theirs) and len(mine) == len(theirs):
        for index, (one, other) in enumerate(zip(mine, theirs, strict=True)):
            yield from differences(one, other, (*path, index))
    elif mine != theirs:
        yield Missed(path, mine, theirs)


def _parts(opaque: Iterable[Data]) -> dict[str, tuple[list[Any], list[Any], list[str]]]:
    """Parts without a field by the element that they stand in; one has elements in order, attributes and a text."""
    found: dict[str, tuple[list[Any], list[Any], list[str]]] = {}
    for part in opaque:
        elements, attributes, words = found.setdefault(part.get("at", ""), ([], [], []))
        elements += [part["element"]] if "element" in part else []
        attributes += [part["attribute"]] if "attribute" in part else []
        words += part.get("text", "").split()
    return {at: (elements, sorted(attributes), words) for at, (elements, attributes, words) in found.items()}


def _shown(value: Any) -> str:
    text = json.dumps(value)
    return text if len(text) <= 60 else text[:57] + "..."
