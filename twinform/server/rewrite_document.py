"""Rewrites whole documents in another process: by passes, in place, and by the formatter."""

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
    """The edits of the text of a document, or why there are none."""

    edits: tuple[TextEdit, ...] = ()
    problem: str = ""


def run_passes(job: CheckJob, pipeline: str) -> Rewritten:
    """What passes change in a document; all else stays as it is written."""
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
        return Rewritten(problem=_first(error.diagnostics))
    except (PassError, PipelineError) as error:
        return Rewritten(problem=str(error))
    lines = Lines(SourceText.of(_data(job)).text)
    starts = [(lines.start(place.line) + place.column - 1, old, new) for place, old, new in updated.changes]
    return Rewritten(tuple(TextEdit(Span(start, start + len(old)), new) for start, old, new in starts))


def lay_out(job: CheckJob) -> Rewritten:
    """What the formatter changes in a document."""
    data = _data(job)
    try:
        made = formatted(data, str(job.path), job.settings.layout, job.settings.load_options.limits)
    except CompileError as error:
        return Rewritten(problem=_first(error.diagnostics))
    before, after = SourceText.of(data).text, SourceText.of(made).text
    return Rewritten((_difference(before, after),) if before != after else ())


def _difference(before: str, after: str) -> TextEdit:
    """The one edit that makes one text of another, without what both begin and end with."""
    most = min(len(before), len(after))
    start = next((n for n in range(most) if before[n] != after[n]), most)
    left = most - start
    end = next((n for n in range(left) if before[-1 - n] != after[-1 - n]), left)
    return TextEdit(Span(start, len(before) - end), after[start : len(after) - end])


def _data(job: CheckJob) -> bytes:
    unsaved = job.load_options.search.unsaved_of(job.path)
    return unsaved if unsaved is not None else job.load_options.search.readable(job.path).read(job.path)


def _first(found: tuple[Diagnostic, ...]) -> str:
    errors = [each for each in found if each.is_error] or list(found)
    first = errors[0] if errors else None
    return f"line {first.location.line}: {first.message}" if first else "it cannot be changed in its place"
