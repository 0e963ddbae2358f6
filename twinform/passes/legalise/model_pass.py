"""The shape of most legalisation passes: each model by itself."""

from abc import abstractmethod

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Model, replace_fields
from twinform.passes.framework.base import Pass


class ModelPass(Pass):
    """A pass that looks at the root-level models one by one."""

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with every model passed through."""
        return replace_fields(document, models=tuple(self.run_model(model, sink) for model in document.models))

    @abstractmethod
    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model after the pass."""
