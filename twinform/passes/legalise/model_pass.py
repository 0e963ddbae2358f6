"""The shape of most legalisation passes: each model by itself."""

from abc import abstractmethod

from twinform.diagnostics import Notes
from twinform.ir import Document, Model, replace_fields
from twinform.passes.base import Pass


class ModelPass(Pass):
    """A pass that looks at the root-level models one by one."""

    def run(self, document: Document, notes: Notes) -> Document:
        """The document with every model passed through."""
        return replace_fields(document, models=tuple(self.run_model(model, notes) for model in document.models))

    @abstractmethod
    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model after the pass."""
