"""The step over: from here on the document is SDF."""

from typing import ClassVar

from twinform.diagnostics import Fate, Notes
from twinform.ir import Document, Format
from twinform.passes.base import Pass
from twinform.passes.legalise.carrier import NAMESPACE, PREFIX


class RetargetSdf(Pass):
    """Declare the document to be SDF of a version, with the prefix of the carriers where there are any.

    Changes: format, version and namespaces of the document.
    Never touches: anything in it.
    Diagnostics: none.
    """

    name: ClassVar[str] = "retarget-sdf"
    version: str

    def run(self, document: Document, notes: Notes) -> Document:
        """The document in terms of SDF."""
        kept = tuple((prefix, uri) for prefix, uri in document.namespaces if prefix not in {"", PREFIX})
        carried = any(entry.fate is Fate.CARRIED for entry in notes.entries)
        carriers = carried or (PREFIX, NAMESPACE) in document.namespaces
        return document.model_copy(
            update={
                "format": Format.SDF,
                "version": self.version,
                "namespaces": (*kept, (PREFIX, NAMESPACE)) if carriers else kept,
            }
        )
