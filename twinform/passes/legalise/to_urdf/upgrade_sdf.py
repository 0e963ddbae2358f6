"""Upgrading SDF to the newest version before the conversion to URDF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document
from twinform.passes.carriers.annotations import with_mixed_words
from twinform.passes.framework.pass_base import Pass
from twinform.passes.sdf_versions import raise_words


class UpgradeSdf(Pass):
    """Upgrade the file to the newest SDF, as all passes after this one know it.

    Changes: those of the steps between the versions, and carriers of newer parts come back.
    Never touches: names, which URDF does not want to be unlike each other; what no newer version has, which the last
    pass carries.
    Diagnostics: those of the steps.
    """

    name: ClassVar[str] = "upgrade-sdf"
    carriers: bool = True
    mixed: bool = False

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document in new syntax; it still declares its version, for the reverse conversion."""
        if self.carriers and self.mixed:
            document = document.copy(models=tuple(map(with_mixed_words, document.models)))
        # All passes after this one know the newest syntax only, instead of each knowing twelve
        # versions.
        for step in raise_words(document.version, carriers=self.carriers, mixed=self.carriers and self.mixed):
            document = step.run(document, sink)
        return document
