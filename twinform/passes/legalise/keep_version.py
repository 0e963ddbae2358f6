"""SDF in another version of SDF."""

from typing import ClassVar

from twinform.diagnostics import Notes
from twinform.diagnostics.rules import to_sdf
from twinform.ir import Document
from twinform.passes.base import Pass


class KeepVersion(Pass):
    """Refuse to write an SDF document in another version than its own, which would have to be translated.

    Changes: nothing.
    Diagnostics: `version-change-unsupported`.
    """

    name: ClassVar[str] = "keep-version"
    version: str

    def run(self, document: Document, notes: Notes) -> Document:
        """The document as it came."""
        message = f"the file is SDF {document.version} and cannot be written as {self.version} yet"
        where = document.location.at("@version")
        notes.report(to_sdf.VERSION_CHANGE_UNSUPPORTED, message, where, found=document.version, expected=self.version)
        return document
