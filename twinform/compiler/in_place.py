"""Conversions into a file that is there: only what has changed is changed in it, and every other byte stays."""

from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.conversion import Conversion
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.input.loading import LoadOptions, read, read_tree
from twinform.compiler.input.parsing import UnreadableError, read_bytes
from twinform.compiler.output.emitting import document_tree
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import EDIT_CONFLICT
from twinform.ir import Document
from twinform.passes import PassInstrumentation
from twinform.schemas import XmlElement, path_of
from twinform.text import LineColumn, Lines, Merge, SourceText, UndecodableError, UnplacedError, apply, edits, merge

_ADDITIVE = "gazebo"
"""Elements of URDF that add up where they refer to the same part."""


class TextChange(NamedTuple):
    """A piece of a file that becomes another one; one of both may be empty."""

    place: LineColumn
    old: str
    new: str


class Updated(NamedTuple):
    """What a file is converted to, its bytes with only what this changes, and these changes in their order.

    `source` are the bytes that were read: who writes the file looks whether they still stand there.
    """

    conversion: Conversion
    data: bytes
    changes: tuple[TextChange, ...]
    source: bytes


def convert_in_place(
    request: ConversionRequest,
    path: Path,
    load_options: LoadOptions,
    *,
    instrumentation: PassInstrumentation | None = None,
) -> Updated:
    """Convert a file to its own format, and change in it only what the conversion changes.

    Raises:
        CompileError: it cannot be converted, or cannot be changed in its place.
    """
    data = file_bytes(path, DiagnosticSink(str(path), load_options.strict), load_options)
    return convert_bytes_in_place(request, data, str(path), load_options, instrumentation=instrumentation)


def convert_bytes_in_place(
    request: ConversionRequest,
    data: bytes,
    name: str,
    load_options: LoadOptions,
    *,
    instrumentation: PassInstrumentation | None = None,
) -> Updated:
    """Do what `convert_in_place` does with the bytes of a file whose path is `name`.

    Raises:
        CompileError: they cannot be converted, or cannot be changed in their place.
    """
    request = replace(request, comments=False)  # the text of the file has them
    # The document is written twice, as it was before the passes and after: what differs between
    # these trees is changed in the tree of the file. What our writer spells otherwise than the
    # author is the same in both, and never touched.
    conversion = run_conversion(request, data, load_options, name=name, instrumentation=instrumentation)
    loaded = read(data, load_options, name=name)
    if loaded.document is None:  # it could be converted a moment ago
        raise CompileError(loaded.diagnostics)
    sink = DiagnosticSink(name, load_options.strict)
    return updated(data, loaded.document, conversion, sink, same=True)


def file_bytes(path: Path, sink: DiagnosticSink, load_options: LoadOptions) -> bytes:
    """The bytes of a file.

    Raises:
        CompileError: it cannot be read.
    """
    search = load_options.search
    unsaved = search.unsaved_of(path)
    try:
        return read_bytes(path, sink, load_options.limits, search.readable(path)) if unsaved is None else unsaved
    except UnreadableError as error:
        raise CompileError(tuple(sink.diagnostics), unreadable=True) from error


def updated(source: bytes, before: Document, conversion: Conversion, sink: DiagnosticSink, *, same: bool) -> Updated:
    """A file with what a conversion has changed in a document; `same` means that this is the document of the file.

    Raises:
        CompileError: the file has changed too, or its text cannot be followed.
    """
    try:
        own, _ = read_tree(source, DiagnosticSink(sink.file))
    except UnreadableError as error:
        raise CompileError(read(source, LoadOptions(), name=sink.file).diagnostics, unreadable=True) from error
    try:
        merged = _merged(document_tree(before), document_tree(conversion.document), own, same=same)
        if not merged.conflicts:
            return _patched(source, own, merged.tree, conversion)
    except (UnplacedError, UndecodableError, UnicodeEncodeError) as error:
        sink.report(EDIT_CONFLICT, f"cannot be changed in place: {error}", Location(line=1, path="/"))
    else:
        for element, message in merged.conflicts:
            where = Location(line=element.sourceline or 0, path=path_of(element))
            sink.report(EDIT_CONFLICT, f"cannot be changed in place: {message}", where)
    raise CompileError((*conversion.diagnostics, *sink.diagnostics))


def _merged(before: XmlElement, after: XmlElement, own: XmlElement, *, same: bool) -> Merge:
    at = _model_in_world(before, own)
    if at is not None:
        before, after = before[0], after[0]
    return merge(before, after, own, at=at, same=same, additive=_ADDITIVE)


def _patched(source: bytes, own: XmlElement, tree: XmlElement, conversion: Conversion) -> Updated:
    text = SourceText.of(source)
    made = sorted(edits(text, own, tree), key=lambda edit: edit.span)
    lines = Lines(text.text)
    changes = [TextChange(lines.place(span.start), span.of(text.text), new) for span, new in made]
    return Updated(conversion, text.with_text(apply(text.text, made)).data, tuple(changes), source)


def _model_in_world(before: XmlElement, own: XmlElement) -> XmlElement | None:
    """Where the only model of a document stands in a file that has it in a world; None for any other file.

    Raises:
        UnplacedError: it is not there, or there are several.
    """
    model = before[0] if len(before) == 1 and before[0].tag == "model" else None
    if model is None or own.find("world") is None:
        return None
    found = [each for each in own.iterfind("world/model") if each.get("name") == model.get("name")]
    if len(found) != 1:
        raise UnplacedError(f"it is a world, in which {len(found) or 'no'} models are called {model.get('name')!r}")
    return found[0]
