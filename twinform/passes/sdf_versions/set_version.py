"""Setting the version of the document, after all other passes between versions."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate
from twinform.ir import Document, census_of
from twinform.passes.carriers.carriers import NAMESPACE, PREFIX, has_ours
from twinform.passes.framework.pass_base import Pass
from twinform.passes.shared.replaced_shapes import REPLACED


class SetVersion(Pass):
    """Declare the document to be SDF of a version, with the prefix of the carriers where there are any.

    Changes: version and namespaces of the document.
    """

    name: ClassVar[str] = "set-version"
    version: str

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document in its new version."""
        namespaces = document.namespaces
        replaced = bool(census_of(document) & REPLACED) and has_ours(document)
        carried = replaced or any(entry.fate is Fate.CARRIED for entry in sink.entries)
        if carried and (PREFIX, NAMESPACE) not in namespaces:
            # The prefix is ours from here on, also where the file bound it to something else.
            namespaces = (*(pair for pair in namespaces if pair[0] != PREFIX), (PREFIX, NAMESPACE))
        return document.copy(version=self.version, namespaces=namespaces)
