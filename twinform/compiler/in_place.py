"""Conversions in place: only what a conversion changes is changed in the file, and every other byte stays."""

from pathlib import Path

from twinform.compiler.driver import Conversion, run_conversion
from twinform.compiler.errors import CompileError
from twinform.compiler.input.loading import LoadOptions, read, read_tree
from twinform.compiler.input.parsing import read_bytes
from twinform.compiler.output.emitting import document_tree
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules.edits import EDIT_CONFLICT
from twinform.ir import Document
from twinform.passes import PassInstrumentation
from twinform.schemas import XmlElement
from twinform.text import SourceText, UndecodableError, UnplacedError, merge, patch


def convert_in_place(
    request: ConversionRequest,
    path: Path,
    load_options: LoadOptions,
    *,
    instrumentation: PassInstrumentation | None = None,
) -> tuple[Conversion, bytes]:
    """What a file is converted to, in its own format, and the bytes of the file with only these changes.

    Raises:
        CompileError: it cannot be converted, or cannot be changed in its place.
    """
    conversion = run_conversion(request, str(path), load_options, name=str(path), instrumentation=instrumentation)
    loaded = read(str(path), load_options, name=str(path))
    sink = DiagnosticSink(str(path), load_options.strict)
    patched = b""
    if loaded.document is None:
        sink.extend(loaded.diagnostics)
    else:
        patched = _patched(read_bytes(path, sink, load_options.limits), loaded.document, conversion, sink)
    if sink.has_errors:
        raise CompileError((*conversion.diagnostics, *sink.diagnostics))
    return conversion, patched


def _patched(source: bytes, before: Document, conversion: Conversion, sink: DiagnosticSink) -> bytes:
    """The bytes of a file with what a conversion has changed in its document; findings where that fails."""
    own, _ = read_tree(source, DiagnosticSink(sink.file))
    merged = merge(document_tree(before), document_tree(conversion.document), own)
    for element, message in merged.conflicts:
        where = Location(line=element.sourceline or 0, path=_path(element))
        sink.report(EDIT_CONFLICT, f"cannot be changed in place: {message}", where)
    if merged.conflicts:
        return source
    try:
        return patch(SourceText.of(source), own, merged.tree).data
    except (UnplacedError, UndecodableError, UnicodeEncodeError) as error:
        sink.report(EDIT_CONFLICT, f"cannot be changed in place: {error}", Location(line=1, path="/"))
        return source


def _path(element: XmlElement) -> str:
    return element.getroottree().getpath(element)
