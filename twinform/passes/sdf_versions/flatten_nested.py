"""Flattening nested models, which SDF has since 1.5."""

from functools import partial
from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Document, Model, World, count_parts, rewrite
from twinform.passes.carriers.annotations import without_synthesized
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.flattening import flatten
from twinform.passes.shared.nodes import piece
from twinform.schemas import parse_version


class FlattenNested(VersionPass):
    """Bring the links, joints and frames of nested models up into the model, by the names `inner::name`.

    Changes: the nested models themselves are carried.
    Diagnostics: `older-version` for each.
    """

    name: ClassVar[str] = "flatten-nested"
    source: str

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document without models in models."""
        models = tuple(self._flat(model, keeper) for model in document.models)
        return rewrite(document.copy(models=models), World, partial(self._world, keeper))

    def _world(self, keeper: VersionKeeper, world: World) -> World:
        return world.copy(models=tuple(self._flat(model, keeper) for model in world.models))

    def _flat(self, model: Model, keeper: VersionKeeper) -> Model:
        if not model.models:
            return model
        flat = without_synthesized(flatten(model, lambda frame, shell: frame))
        since = parse_version(self.source)  # whose syntax the nested model is in
        # Carriers are unpacked last in, first out: from the end, so that each model comes back at
        # its index.
        for index in reversed(range(len(model.models))):
            nested = model.models[index]
            message = f"model {nested.name!r} is in model {model.name!r}, which SDF has since 1.5"
            keeper.sink.report(rules.OLDER_VERSION, message, nested.location, found=nested.name)
            condition = VersionCondition(since=since, index=index, instead=f"{nested.name}::")
            where, weight = nested.location, count_parts(nested.copy(links=(), joints=()))
            flat = keeper.keep(flat, [piece(nested, "model")], condition, rules.OLDER_VERSION, message, where, weight)
        return flat
