"""Dropping carriers and annotations from where they mean nothing."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Model
from twinform.passes.carriers.misplaced import without_misplaced
from twinform.passes.framework.pass_base import ModelPass


class DropMisplaced(ModelPass):
    """Drop the carriers and annotations that stand where no conversion puts them.

    Changes: a carrier in a number or a pose goes, and one about an element that there is not in the one around it.
    Somebody copied it there, and unpacked it would be content that nobody wrote.
    Never touches: all others; whether these still match the file is for the passes that unpack them.
    Diagnostics: `stale-carrier` for each.
    """

    name: ClassVar[str] = "drop-misplaced"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with carriers only where they mean something."""
        return without_misplaced(model, sink)
