"""Upgrading documents of different SDF versions to the newest of them."""

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.schemas import parse_version, versions_of


def newest(*versions: str | None) -> str | None:
    """The newest of some versions; None where none of them is one."""
    known = [version for version in versions if version in versions_of("sdf")]
    return max(known, key=parse_version, default=versions[0])


def upgrade_document(document: Document, version: str | None, sink: DiagnosticSink, *, carriers: bool) -> Document:
    """The document in the syntax of a version that is not older than its own."""
    known = versions_of("sdf")
    if document.version == version or document.version not in known or version not in known:
        return document
    from twinform.passes.sdf_versions import raise_for_merging  # noqa: PLC0415 - few files need all the steps

    own = DiagnosticSink(document.location.file or sink.file, sink.strict, origins=sink.origins)
    for step in raise_for_merging(document.version, version, carriers=carriers):
        document = step.run(document, own)
    # A file that is included a hundred times is reported once.
    sink.extend_new(own.diagnostics)
    sink.entries.extend(own.entries)
    return document
