"""Rewrites of whole documents, which run in the worker's process: by passes, in place, and by the formatter."""

from typing import NamedTuple

from twinform.compiler.conversion_error import CompileError
from twinform.compiler.formatting import formatted
from twinform.compiler.in_place import convert_in_place
from twinform.compiler.input.loading import read
from twinform.compiler.request import ConversionRequest
from twinform.diagnostics import Diagnostic, Span, TextEdit
from twinform.passes import FilesPass, PassError, PipelineError, parse_pipeline
from twinform.server.checking import CheckJob
from twinform.text import Lines, SourceText


class Rewritten(NamedTuple):
    """The edits of a document, or the problem that keeps it from being rewritten."""

    edits: tuple[TextEdit, ...] = ()
    problem: str = ""


def run_passes(job: CheckJob, pipeline: str) -> Rewritten:
    """Run passes on a document in place, and return what they change."""
    load_options = job.load_options
    document = read(str(job.path), load_options).document
    if document is None:
        return Rewritten(problem="the document cannot be read: fix what is wrong with it first")
    to = document.format.value
    version = document.version if to == "sdf" else None
    try:
        passes = parse_pipeline(pipeline)
        if any(isinstance(step, FilesPass) for step in passes):
            return Rewritten(problem="it makes files, and an editor changes documents only; use `twinform convert`")
        request = ConversionRequest(to=to, sdf_version=version, passes=passes)
        updated = convert_in_place(request, job.path, load_options)
    except CompileError as error:
        return Rewritten(problem=_first_error(error.diagnostics))
    except (PassError, PipelineError) as error:
        return Rewritten(problem=str(error))
    lines = Lines(SourceText.of(_read(job)).text)
    starts = [(lines.start(place.line) + place.column - 1, old, new) for place, old, new in updated.changes]
    return Rewritten(tuple(TextEdit(Span(start, start + len(old)), new) for start, old, new in starts))


def format_document(job: CheckJob) -> Rewritten:
    """Format a document, and return what changes."""
    data = _read(job)
    try:
        made = formatted(data, str(job.path), job.settings.layout, job.settings.load_options.limits)
    except CompileError as error:
        return Rewritten(problem=_first_error(error.diagnostics))
    before, after = SourceText.of(data).text, SourceText.of(made).text
    return Rewritten((_single_edit(before, after),) if before != after else ())


def _single_edit(before: str, after: str) -> TextEdit:
    """Return the one edit between two texts, without their common beginning and end."""
    most = min(len(before), len(after))
    start = next((n for n in range(most) if before[n] != after[n]), most)
    left = most - start
    end = next((n for n in range(left) if before[-1 - n] != after[-1 - n]), left)
    return TextEdit(Span(start, len(before) - end), after[start : len(after) - end])


def _read(job: CheckJob) -> bytes:
    unsaved = job.load_options.search.unsaved_of(job.path)
    return unsaved if unsaved is not None else job.load_options.search.readable(job.path).read(job.path)


def _first_error(found: tuple[Diagnostic, ...]) -> str:
    errors = [each for each in found if each.is_error] or list(found)
    first = errors[0] if errors else None
    return f"line {first.location.line}: {first.message}" if first else "it cannot be changed in its place"
