"""Reverse conversion of lumped collision names in contact sensors and plugins."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Element, GazeboExtension, Model
from twinform.passes.carriers.lumped_names import has_annotations, restored
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.to_sdf.follow_lumped_names import names_of_libsdformat


class RestoreLumpedNames(ModelPass):
    """Name collisions in `<gazebo>` elements as libsdformat lumps them, where the source did.

    Changes: a text beside which an annotation has the original.
    Never touches: a text that was edited since, or whose old name does not mean that collision any more.
    Diagnostics: `stale-carrier` for these.
    """

    name: ClassVar[str] = "restore-lumped-names"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with the names of the source."""
        if not has_annotations(model):
            return model
        names, stale = names_of_libsdformat(model), list[Element]()

        def restore(extension: GazeboExtension) -> GazeboExtension:
            content = tuple(restored(each, names, stale) for each in extension.content)
            return extension.copy(content=content)

        model = model.copy(extensions=tuple(map(restore, model.extensions)))
        for annotation in stale:
            message = f"{annotation.get('instead_of')!r} was called {annotation.text!r}, which now names something else"
            sink.report(STALE_CARRIER, message, annotation.location, found=annotation.text)
        return model
