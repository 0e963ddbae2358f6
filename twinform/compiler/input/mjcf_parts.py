"""Checks a file of MJCF that others include: that it is XML. Its content is checked with the files that include it."""

from pathlib import Path

from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.input.loading import bytes_of
from twinform.compiler.input.parsing import UnreadableError, parse
from twinform.diagnostics import DiagnosticSink


def check_mjcf_part(path: Path, load_options: LoadOptions) -> LoadResult:
    """Check that a file which others include is well-formed XML."""
    sink = DiagnosticSink(str(path), load_options.strict)
    load_options.search.seen.add(path)
    allowances = load_options.allowances(sink.file)
    data: bytes | None = None
    try:
        data = bytes_of(path, sink, load_options)
        allowances.read(data, sink)
        parse(data, sink, load_options.limits)
    except UnreadableError:
        return LoadResult(sink.file, None, tuple(sink.diagnostics), unreadable=True, content=data)
    allowances.checked = True
    allowances.settle(sink)
    return LoadResult(sink.file, None, tuple(sink.diagnostics), content=data, allowed=tuple(sink.allowed))
