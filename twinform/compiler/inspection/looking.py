"""Passes that only look: run by `check` for what they find."""

from pathlib import Path

from twinform.compiler.loading import Reading
from twinform.compiler.other_documents import OtherDocuments
from twinform.compiler.uris import LocalAssets
from twinform.diagnostics import Notes
from twinform.ir import Document
from twinform.passes import CompanionPass, Pass, Pipeline


class LookingError(Exception):
    """A pass does more than look."""


def look(document: Document, passes: Pipeline, notes: Notes, path: Path, how: Reading) -> None:
    """Run passes on a document for what they report.

    Raises:
        LookingError: one of them changes the document, or makes a file.
        PassError: one of them is at fault.
    """
    lent = passes.with_files(LocalAssets(how.search, path), OtherDocuments(how, str(path)).read)
    for step in lent:
        if isinstance(step, CompanionPass):
            raise _refusal(step, "writes a file")
        if Pipeline((step,)).run(document, notes) != document:
            raise _refusal(step, "changes the model")


def _refusal(step: Pass, what: str) -> LookingError:
    return LookingError(f"the pass {step.name} {what}, and check only looks; run it with convert --passes")
