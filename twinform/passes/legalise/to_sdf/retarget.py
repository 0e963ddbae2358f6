"""Change of format from URDF to SDF: after this pass the document is SDF."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Format, Model
from twinform.passes.carriers.annotations import (
    came_from,
    source_version,
    with_mixed_words,
    with_provenance,
    without_annotation,
    without_provenance,
)
from twinform.passes.carriers.carriers import NAMESPACE, PREFIX, has_ours
from twinform.passes.framework.pass_base import Pass
from twinform.passes.shared.poses import BODY
from twinform.schemas import versions_of


class RetargetSdf(Pass):
    """Declare the document to be SDF of a version, with the prefix of the carriers where there are any.

    Changes: format, version and namespaces of the document; the model is annotated as one that came from URDF.
    Never touches: anything in it.
    Diagnostics: none.
    """

    name: ClassVar[str] = "retarget-sdf"
    version: str
    carriers: bool = True
    mixed: bool = False
    keeps_provenance: bool = False
    """Whether a model of SDF that is back stays annotated as such, for a pass that writes the version of its source."""

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document as SDF."""
        kept = tuple((prefix, uri) for prefix, uri in document.namespaces if prefix not in {"", PREFIX})
        models = tuple(self._from_urdf(model, document) for model in document.models)
        before = source_version(document, Format.SDF)
        return document.copy(
            format=Format.SDF,
            version=self.version if before is None or before in versions_of("sdf") else before,
            models=models,
            namespaces=(*kept, (PREFIX, NAMESPACE)) if any(map(has_ours, models)) else kept,
        )

    def _from_urdf(self, model: Model, document: Document) -> Model:
        """The model, annotated as one that came from URDF, unless it is one of SDF that is back."""
        if came_from(model, Format.SDF):
            links = tuple(without_annotation(link, BODY) for link in model.links)
            back = model.copy(links=links)
            return back if self.keeps_provenance else without_provenance(back)
        if not self.carriers:
            return model
        model = without_provenance(model)
        return with_provenance(with_mixed_words(model) if self.mixed else model, document)
