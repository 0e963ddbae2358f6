"""Documents in memory as input: checked as the file that they would be."""

from collections.abc import Callable

from twinform.compiler.input.gazebo_extensions import check_extensions
from twinform.compiler.input.json import compare_documents
from twinform.compiler.input.load_options import LoadOptions, LoadResult
from twinform.compiler.output.emitting import document_tree, located
from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Document, Format
from twinform.ir.verify import verify
from twinform.schemas import XmlElement


def check_document(
    document: Document,
    sink: DiagnosticSink,
    load_options: LoadOptions,
    lower: Callable[[XmlElement, DiagnosticSink], Document | None],
) -> LoadResult:
    """Report everything that is wrong with a document, as if it were a file: it is, once it is written.

    `lower` makes a document of its tree again.
    """
    try:
        tree = document_tree(document)
    except (ValueError, IndexError) as error:  # a name that is none in XML; no model at all
        compare_documents(document, None, sink)
        if not sink.has_errors:
            sink.report(rules.INVALID_VALUE, f"the document cannot be written: {error}", document.location)
        return LoadResult(sink.file, document, tuple(sink.diagnostics))
    found = DiagnosticSink(sink.file, sink.strict)
    again = lower(tree, found)
    sink.extend(located(diagnostic, document) for diagnostic in found.diagnostics)
    compare_documents(document, again, sink)
    verify(document, sink)
    if document.format is Format.URDF:
        check_extensions(document, sink)
    allowances = load_options.allowances(sink.file)
    allowances.settle(sink)
    allowed = tuple(sink.allowed)
    return LoadResult(sink.file, document, tuple(sink.diagnostics), tree=tree, allowed=allowed, allowances=allowances)
