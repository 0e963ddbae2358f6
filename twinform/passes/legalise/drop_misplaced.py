"""Dropping carriers and annotations from where they mean nothing."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Model
from twinform.passes.carriers.misplaced import without_misplaced
from twinform.passes.framework.pass_base import ModelPass


class DropMisplaced(ModelPass):
    """Drop the carriers and annotations that stand where no conversion puts them.

    Changes: a carrier inside a number or a pose goes, and so does one about an element that cannot be where it stands.
    An edit copied it there; unpacked, it would become content that nobody wrote.
    Never touches: other carriers. The passes that unpack them find out whether they still match the file.
    Diagnostics: `stale-carrier` for each.
    """

    name: ClassVar[str] = "drop-misplaced"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with carriers only where they mean something."""
        return without_misplaced(model, sink)
