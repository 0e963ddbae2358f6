"""Conversions into a file that is there: only what has changed is changed in it, and every other byte stays."""

from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.driver import Conversion, run_conversion
from twinform.compiler.errors import CompileError
from twinform.compiler.input.loading import LoadOptions, read, read_tree
from twinform.compiler.input.parsing import UnreadableError, read_bytes
from twinform.compiler.output.emitting import document_tree
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules.edits import EDIT_CONFLICT
from twinform.ir import Document, Format
from twinform.passes import PassInstrumentation
from twinform.schemas import path_of
from twinform.text import Lines, Place, SourceText, UndecodableError, UnplacedError, apply, edits, merge


class Change(NamedTuple):
    """A piece of a file that becomes another one; one of both may be empty."""

    place: Place
    old: str
    new: str


class Updated(NamedTuple):
    """What a file is converted to, its bytes with only what this changes, and these changes in their order."""

    conversion: Conversion
    data: bytes
    changes: tuple[Change, ...]


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
    conversion = run_conversion(request, str(path), load_options, name=str(path), instrumentation=instrumentation)
    loaded = read(str(path), load_options, name=str(path))
    sink = DiagnosticSink(str(path), load_options.strict)
    if loaded.document is None:  # it could be converted a moment ago
        raise CompileError(loaded.diagnostics)
    return _updated(_bytes(path, sink, load_options), loaded.document, conversion, sink, same=True)


def convert_into(
    request: ConversionRequest, edited: Path, into: Path, load_options: LoadOptions, *, base: Path | None = None
) -> Updated:
    """Convert an edited file, and change in the file `into` only what the edits change.

    The edits are what differs from `base`: the file as it was before them, or else what `into` is converted to.

    Raises:
        CompileError: one of the files cannot be converted, or both sides have changed the same.
    """
    conversion = run_conversion(request, str(edited), load_options, name=str(edited))
    old = str(base) if base else _built(request, edited, into, load_options)
    before = run_conversion(request, old, load_options, name=str(base or into))
    sink = DiagnosticSink(str(into), load_options.strict)
    return _updated(_bytes(into, sink, load_options), before.document, conversion, sink, same=base is None)


def _built(request: ConversionRequest, edited: Path, into: Path, load_options: LoadOptions) -> bytes:
    """What a file is converted to, in the format and the version of the edited one."""
    document = read(str(edited), load_options, name=str(edited)).document
    if document is None:  # it could be converted a moment ago
        raise CompileError(())
    back = replace(request, to=document.format.value, sdf_version=None, urdf_version=None, model=None)
    if document.format is Format.SDF:
        back = replace(back, sdf_version=document.version)
    return run_conversion(back, str(into), load_options, name=str(into)).text.encode()


def _bytes(path: Path, sink: DiagnosticSink, load_options: LoadOptions) -> bytes:
    unsaved = load_options.search.unsaved_of(path)
    try:
        return read_bytes(path, sink, load_options.limits) if unsaved is None else unsaved
    except UnreadableError as error:
        raise CompileError(tuple(sink.diagnostics), unreadable=True) from error


def _updated(source: bytes, before: Document, conversion: Conversion, sink: DiagnosticSink, *, same: bool) -> Updated:
    """A file with what a conversion has changed in a document; `same` means that this is the document of the file.

    Raises:
        CompileError: the file has changed too, or its text cannot be followed.
    """
    try:
        own, _ = read_tree(source, DiagnosticSink(sink.file))
    except UnreadableError as error:
        raise CompileError(read(source, LoadOptions(), name=sink.file).diagnostics, unreadable=True) from error
    merged = merge(document_tree(before), document_tree(conversion.document), own, same=same)
    for element, message in merged.conflicts:
        where = Location(line=element.sourceline or 0, path=path_of(element))
        sink.report(EDIT_CONFLICT, f"cannot be changed in place: {message}", where)
    if not merged.conflicts:
        try:
            text = SourceText.of(source)
            made = sorted(edits(text, own, merged.tree), key=lambda edit: edit.span)
            lines = Lines(text.text)
            changes = [Change(lines.place(span.start), span.of(text.text), new) for span, new in made]
            return Updated(conversion, text.with_text(apply(text.text, made)).data, tuple(changes))
        except (UnplacedError, UndecodableError, UnicodeEncodeError) as error:
            sink.report(EDIT_CONFLICT, f"cannot be changed in place: {error}", Location(line=1, path="/"))
    raise CompileError((*conversion.diagnostics, *sink.diagnostics))
