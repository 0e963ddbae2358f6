"""The looks of Gazebo Classic in the words of gz-sim."""

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes.framework.registry import find_pass, registered_passes

_MATERIALS = "materials"


def in_colors(document: Document, sink: DiagnosticSink) -> Document:
    """The document with material scripts as colors, by the pass that knows them, where it is installed."""
    return find_pass(_MATERIALS)().run(document, sink) if _MATERIALS in registered_passes() else document
