"""Conversions into a file that is there: only what has changed is changed in it, and every other byte stays."""

from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from twinform.compiler.conversion import Conversion
from twinform.compiler.conversion_error import CompileError
from twinform.compiler.driver import run_conversion
from twinform.compiler.input.loading import LoadOptions, LoadResult, bytes_of, read
from twinform.compiler.input.parsing import UnreadableError
from twinform.compiler.output.emitting import document_tree
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import DiagnosticSink, Location
from twinform.diagnostics.rules import EDIT_CONFLICT
from twinform.ir import Document, Format
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
    path: str | Path,
    load_options: LoadOptions,
    *,
    data: bytes | None = None,
    instrumentation: PassInstrumentation | None = None,
) -> Updated:
    """Convert a file to its own format, and change in it only what the conversion changes.

    `data` are its bytes, where they are not those that stand in the file.

    Raises:
        CompileError: it cannot be converted, or cannot be changed in its place.
    """
    sink = DiagnosticSink(str(path), load_options.strict)
    try:
        data = bytes_of(Path(path), sink, load_options) if data is None else data
    except UnreadableError as error:
        raise CompileError(tuple(sink.diagnostics), unreadable=True) from error
    request = replace(request, comments=False)  # the text of the file has them
    # The document is written twice, as it was before the passes and after: what differs between
    # these trees is changed in the tree of the file. What our writer spells otherwise than the
    # author is the same in both, and never touched.
    loaded = read(data, load_options.read_by(request.sdf_version), name=str(path))
    conversion = run_conversion(request, loaded, load_options, name=str(path), instrumentation=instrumentation)
    return updated(loaded, loaded.document, conversion, sink, same=True)


def updated(
    file: LoadResult, before: Document | None, conversion: Conversion, sink: DiagnosticSink, *, same: bool
) -> Updated:
    """A file with what a conversion has changed in a document; `same` means that this is the document of the file.

    Raises:
        CompileError: the file has changed too, or its text cannot be followed.
    """
    own, source = file.tree, file.content
    if own is None or source is None or before is None:
        raise file.error()
    if (
        file.is_mjcf and conversion.document.format is not Format.MJCF
    ):  # its document is in the terms of SDF, and so are all edits
        message = "MJCF cannot be changed in place: convert it with --to mjcf, and name another file with -o"
        sink.report(EDIT_CONFLICT, message, Location(line=1, path="/mujoco"))
        raise CompileError((*conversion.diagnostics, *sink.diagnostics))
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
    changes = [
        TextChange(lines.place(span.start), old, new) for span, new, _ in made if (old := span.of(text.text)) != new
    ]
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
