"""Checks the `<gazebo>` elements of a URDF file."""

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document


def check_extensions(document: Document, sink: DiagnosticSink) -> None:
    """Fold them as a conversion would, only for its diagnostics."""
    if not any(model.extensions for model in document.models):
        return
    from twinform.passes.legalise.to_sdf.fold_gazebo import FoldGazebo  # noqa: PLC0415 - most files have none

    # What a tag means depends on what it refers to, and most of the content is SDF at the place of
    # the reference. One piece of code knows all this, the pass; `check` runs it and keeps only what
    # it reports.
    found = DiagnosticSink(file=sink.file, strict=sink.strict)
    FoldGazebo().run(document, found)
    sink.extend_new(found.diagnostics)
