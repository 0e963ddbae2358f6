"""Documents of MJCF without what only MJCF says, for conversions that are asked for files without elements of ours."""

from dataclasses import replace

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.ir import Document
from twinform.passes.carriers.carriers import without_ours


def without_remainders(document: Document, sink: DiagnosticSink) -> Document:
    """Return the document without remainders and annotations, which the ledger calls dropped; others unchanged."""
    if document.source is None or document.source.step != "mujoco":
        return document
    sink.entries[:] = [replace(each, fate=Fate.DROPPED) if each.fate is Fate.CARRIED else each for each in sink.entries]
    return without_ours(document).copy(namespaces=())
