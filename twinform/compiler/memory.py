"""Documents in memory as input: checked as the file that they would be."""

from twinform.compiler.emitting import document_tree, located
from twinform.compiler.inputs import Checked
from twinform.compiler.json_documents import compare_documents
from twinform.compiler.loading import lower_tree
from twinform.compiler.urdf.extensions import check_extensions
from twinform.diagnostics import Notes
from twinform.diagnostics.rules import structure
from twinform.ir import Document, Format
from twinform.ir.verify import verify


def check_document(document: Document, notes: Notes) -> Checked:
    """Say everything that is wrong with a document, as if it were a file: it is, once it is written."""
    try:
        tree = document_tree(document)
    except (ValueError, IndexError) as error:  # a name that is none in XML; no model at all
        compare_documents(document, None, notes)
        if not notes.has_errors:
            notes.report(structure.INVALID_VALUE, f"the document cannot be written: {error}", document.location)
        return Checked(notes.file, document, tuple(notes.diagnostics))
    found = Notes(notes.file, notes.strict)
    again = lower_tree(tree, found)
    notes.extend(located(diagnostic, document) for diagnostic in found.diagnostics)
    compare_documents(document, again, notes)
    verify(document, notes)
    if document.format is Format.URDF:
        check_extensions(document, notes)
    return Checked(notes.file, document, tuple(notes.diagnostics), tree=tree)
