"""The names of lumped collisions that a robot had in its contact sensors and plugins."""

from typing import ClassVar

from twinform.diagnostics import Notes
from twinform.ir import Model
from twinform.passes.legalise.lumped_names import restored
from twinform.passes.legalise.model_pass import ModelPass


class RestoreLumpedNames(ModelPass):
    """Name collisions in `<gazebo>` elements as libsdformat lumps them, where the source did.

    Changes: a text beside which a mark says what stood there.
    Never touches: a text that was edited since.
    Diagnostics: none.
    """

    name: ClassVar[str] = "restore-lumped-names"

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model with the names of the source."""
        extensions = tuple(
            each.model_copy(update={"content": tuple(map(restored, each.content))}) for each in model.extensions
        )
        return model.model_copy(update={"extensions": extensions}) if extensions != model.extensions else model
