"""Read-only passes, which `check` runs for the diagnostics that they report."""

from pathlib import Path

from twinform.compiler.conversion_error import ReadOnlyPassError
from twinform.compiler.expand_includes import OtherDocuments
from twinform.compiler.input.loading import LoadOptions
from twinform.compiler.other_xacro import assets_of
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes import FilesPass, Pass, Pipeline


def run_read_only(
    document: Document, passes: Pipeline, sink: DiagnosticSink, path: Path, load_options: LoadOptions
) -> None:
    """Run passes on a document for their diagnostics.

    Raises:
        ReadOnlyPassError: one of them changes the document, or makes a file.
        PassError: one of them is at fault.
    """
    lent = passes.with_files(assets_of(path, load_options), OtherDocuments(load_options, str(path)).read)
    for step in lent:
        if isinstance(step, FilesPass):
            raise _refusal(step, "writes a file")
        # What a pass does counts, and not a flag that it declares: a pass of another package needs
        # no new declaration, and one that would change the model is refused instead of being run
        # for nothing.
        if Pipeline((step,)).run(document, sink) != document:
            raise _refusal(step, "changes the model")


def _refusal(step: Pass, what: str) -> ReadOnlyPassError:
    return ReadOnlyPassError(
        f"the pass {step.name} {what}, and check runs read-only passes; run it with convert --passes"
    )
