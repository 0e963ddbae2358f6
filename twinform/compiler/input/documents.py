"""Checks documents in memory as the files that they would be, which have to say everything that they do."""

import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple, cast

from twinform.compiler.input.front_ends import check_extensions
from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.output.emitting import document_tree, located
from twinform.compiler.output.json import Data, JsonPath, is_array, is_object, json_data
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.diagnostics.wording import cut
from twinform.ir import Document, Format, Node
from twinform.ir.record import field_value
from twinform.ir.verify import verify
from twinform.lazy import lazy_pattern
from twinform.schemas import XmlElement

_ASIDE = frozenset({"$schema", "namespaces", "order", "spelling"})
"""Fields that are not compared: the version of the schema; prefixes, which a file may have more of; and fields that are
not about the robot."""
_NOT_IN_XML = lazy_pattern("[\0-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_NOWHERE = object()
_PARTS_OF_POSES, _ZEROS = frozenset({"xyz", "rpy"}), [0.0, 0.0, 0.0]


class Missed(NamedTuple):
    """A place where a document differs from the file that was made of it."""

    path: JsonPath
    mine: Any
    theirs: Any

    def report(self, format_: str, where: Location, sink: DiagnosticSink) -> None:
        """Report that the format cannot express what stands there."""
        name = "/".join(map(str, self.path))
        became = "leaves it out" if self.theirs is _NOWHERE else f"has {shown(self.theirs)} there"
        found = "nothing" if self.mine is _NOWHERE else shown(self.mine)
        message = f"{name}: {format_.upper()} cannot express {found}; a file in that format {became}"
        hint = "if it stands in 'opaque', write it in the field that is meant for it"
        sink.report(rules.INVALID_VALUE, message, where, found=found, help=hint)


def check_document(
    document: Document,
    sink: DiagnosticSink,
    load_options: LoadOptions,
    lower: Callable[[XmlElement, DiagnosticSink], Document | None],
) -> LoadResult:
    """Write a document, read it again with `lower`, and report everything that is wrong with it."""
    unwritable = unwritable_part(json_data(document))
    if unwritable is not None:
        path, message = unwritable
        sink.report(rules.INVALID_VALUE, message, _nearest(document, path).location)
        return LoadResult(sink.file, document, tuple(sink.diagnostics))
    try:
        tree = document_tree(document)
    except ValueError as error:  # a name that is none in XML
        sink.report(rules.INVALID_VALUE, f"the document cannot be written: {error}", document.location)
        return LoadResult(sink.file, document, tuple(sink.diagnostics))
    found = DiagnosticSink(sink.file, sink.strict)
    again = lower(tree, found)
    sink.extend(located(diagnostic, document) for diagnostic in found.diagnostics)
    compare_documents(document, again, sink)
    verify(document, sink)
    if document.format is Format.URDF:
        check_extensions(document, sink)
    allowances = load_options.allowances(sink.file)
    allowances.settle(sink)
    allowed = tuple(sink.allowed)
    return LoadResult(sink.file, document, tuple(sink.diagnostics), tree=tree, allowed=allowed, allowances=allowances)


def compare_documents(document: Document, again: Document | None, sink: DiagnosticSink) -> None:
    """Report what the format of a document cannot express: `again` is the document that its text is read as."""
    if again is None or sink.has_errors:
        return
    missed = first_difference(json_data(document), again)
    if missed is not None:
        missed.report(document.format, _nearest(document, missed.path).location, sink)


def first_difference(data: Data, document: Document) -> Missed | None:
    """Return the first place where a document differs from JSON data; None where it has all of the data."""
    return next(_differences(without_empty(data), without_empty(json_data(document)), ()), None)


def unwritable_part(data: Data) -> tuple[JsonPath, str] | None:
    """Return the path of data that no file can express, with a message: a text, or the number of robots in URDF."""
    count = len(data.get("models", ()))
    if data["format"] == Format.URDF and count != 1:
        return ("models",), f"models: has {count} items; expected 1"
    return next(
        (
            (path, f"{'/'.join(map(str, path))}: is {shown(text)}, which XML cannot hold here")
            for path, text in _texts(data, ())
            if _NOT_IN_XML.search(text)
        ),
        None,
    )


def _texts(data: Any, path: JsonPath) -> Iterator[tuple[JsonPath, str]]:
    if isinstance(data, str):
        yield path, data
    elif is_object(data) or is_array(data):
        for step, inner in data.items() if is_object(data) else enumerate(data):
            yield from _texts(inner, (*path, step))


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


def without_empty(data: Any) -> Any:
    """Return the data without empty objects, empty arrays and null, which all mean that nothing was written.

    Calls itself once for each level, so that what is as deep as XML may be can be read.
    """
    if is_array(data):
        return list(map(without_empty, data))
    if not is_object(data):
        return data
    values = zip(data, map(without_empty, data.values()), strict=True)
    return {name: value for name, value in values if value not in ({}, [], None)}


def _differences(mine: Any, theirs: Any, path: JsonPath) -> Iterator[Missed]:
    """Yield the places where two documents differ."""
    if is_object(mine) and is_object(theirs):
        for name in [*mine, *(name for name in theirs if name not in mine)]:
            if name == "opaque":
                one, other = (_parts(each.get(name, ())) for each in (mine, theirs))
                if one != other:
                    yield Missed((*path, name), mine.get(name, _NOWHERE), theirs.get(name, _NOWHERE))
            elif name not in _ASIDE:
                yield from _differences(mine.get(name, _NOWHERE), theirs.get(name, _NOWHERE), (*path, name))
    elif is_array(mine) and is_array(theirs) and len(mine) == len(theirs):
        for index, (one, other) in enumerate(zip(mine, _in_order_of(mine, theirs), strict=True)):
            yield from _differences(one, other, (*path, index))
    elif mine is _NOWHERE and theirs == _ZEROS and path[-1] in _PARTS_OF_POSES:
        return  # SDF has both parts in one text, so a document that comes from URDF, or is made by hand, may lack one
    elif mine != theirs or isinstance(mine, bool) is not isinstance(theirs, bool):  # True == 1
        yield Missed(path, mine, theirs)


def _in_order_of(mine: list[Any], theirs: list[Any]) -> list[Any]:
    """Parts in the order of others with the same names: a file has all of them in the order of their lines."""
    names, others = ([each.get("name") if is_object(each) else None for each in parts] for parts in (mine, theirs))
    if names == others or Counter(names) != Counter(others):
        return theirs
    waiting: dict[Any, list[Any]] = {name: [] for name in names}
    for name, part in zip(reversed(others), reversed(theirs), strict=True):
        waiting[name].append(part)
    return [waiting[name].pop() for name in names]


def _parts(opaque: Iterable[Data]) -> dict[str, tuple[list[Any], list[Any], list[str]]]:
    """Group parts without a field by the element that they stand in: its elements, attributes and words."""
    found: dict[str, tuple[list[Any], list[Any], list[str]]] = {}
    for part in opaque:
        elements, attributes, words = found.setdefault(part.get("at", ""), ([], [], []))
        elements += [part["element"]] if "element" in part else []
        attributes += [part["attribute"]] if "attribute" in part else []
        words += part.get("text", "").split()
    return {at: (elements, sorted(attributes), words) for at, (elements, attributes, words) in found.items()}


def shown(value: Any) -> str:
    """Return a value as shortened JSON."""
    return cut(json.dumps(value))
