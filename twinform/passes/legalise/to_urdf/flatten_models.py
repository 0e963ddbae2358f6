"""URDF has no models inside models."""

from functools import partial
from typing import ClassVar

from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import Frame, Model, count_parts
from twinform.passes.legalise.flattening import flatten
from twinform.passes.legalise.nodes import piece
from twinform.passes.legalise.to_urdf.base import ToUrdfPass
from twinform.passes.legalise.to_urdf.keeper import Keeper


class FlattenModels(ToUrdfPass):
    """Bring the links, joints and frames of nested models up into the model.

    Changes: 1. they are called `inner::name`, and what names them does so too; 2. a frame called `inner` stands for the
    nested model's own frame, and poses that were relative to it name it; 3. all else that the nested model says is
    carried on that frame.
    Diagnostics: `include-not-expanded` for includes in any of the models; in the ledger `nested-model`.
    """

    name: ClassVar[str] = "flatten-models"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model without models in it."""
        _refuse_includes(model, keeper)
        if not model.models or keeper.notes.has_errors:
            return model
        return flatten(model, partial(_keep, keeper))


def _keep(keeper: Keeper, frame: Frame, shell: Model) -> Frame:
    message = f"nested model {frame.name!r} is flattened"
    weight = count_parts(shell)
    return keeper.keep(frame, [piece(shell, "model")], rules.NESTED_MODEL, message, shell.location, weight)


def _refuse_includes(model: Model, keeper: Keeper) -> None:
    for include in model.includes:
        message = f"model {model.name!r} includes {include.uri!r}, which was not read"
        keeper.notes.report(rules.INCLUDE_NOT_EXPANDED, message, include.location, found=include.uri)
    for nested in model.models:
        _refuse_includes(nested, keeper)
