"""The shape of the passes on the way to URDF."""

from abc import abstractmethod

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Format, Model, replace_fields
from twinform.ir.frames import FrameError
from twinform.passes.carriers.provenance import came_from
from twinform.passes.framework.base import Pass
from twinform.passes.legalise.to_urdf.keeper import Keeper


class ToUrdfPass(Pass):
    """A pass over the one model that becomes the robot. After an error there is nothing left to do.

    `carriers` says whether parts that URDF cannot say travel in carriers or only into the ledger.
    """

    carriers: bool = True

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with its model passed through."""
        if sink.has_errors:
            return document
        keeper = Keeper(sink, self.carriers, any(came_from(model, Format.URDF) for model in document.models))
        try:
            return replace_fields(document, models=tuple(self.run_model(model, keeper) for model in document.models))
        except FrameError as error:
            error.report(sink)
            return document

    @abstractmethod
    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model after the pass."""
