"""What must hold for any input at all; `fuzz/` runs these under atheris, and the tests on what that has found."""

import twinform
from twinform.compiler import check
from twinform.compiler.output.emitting import emit
from twinform.diagnostics import DiagnosticSink
from twinform.passes import PipelineError, parse_pipeline


def load(data: bytes) -> None:
    """Nothing but findings comes of any bytes, and what is accepted is the same text once written, read and written."""
    checked = check(data)
    if not checked.accepted or checked.document is None:
        assert checked.diagnostics, "refused without a word"
        return
    sink = DiagnosticSink()
    text = emit(checked.document, sink)
    if not sink.has_errors:
        assert emit(twinform.loads(text), sink) == text, "another text once read again"


def pipeline(data: bytes) -> None:
    """A text is a pipeline, whose own text is the same pipeline, or a PipelineError."""
    try:
        found = parse_pipeline(data.decode("utf-8", errors="replace"))
    except PipelineError:
        return
    assert parse_pipeline(str(found)) == found, "another pipeline once written and parsed again"
