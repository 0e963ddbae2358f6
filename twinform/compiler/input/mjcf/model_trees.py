"""Which trees of bodies are one model, and what it is called.

Each tree is a model of its own, unless the file was written of a document that has them otherwise: then carriers say
which bodies at the top are in which model.
"""

from collections.abc import Collection, Mapping, Sequence
from typing import NamedTuple, Self

from twinform.compiler.input.mjcf.carried_texts import CarriedText, are_of_sdf
from twinform.compiler.input.mjcf.pieces import Piece
from twinform.ir import Model
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.carriers.mjcf_texts import DOCUMENT, SEVERAL, annotated_trees


class ModelTrees(NamedTuple):
    """The trees of one model, the name that a carrier gives it, and where it is if its trees do not say that."""

    trees: tuple[Piece, ...]
    name: str | None = None
    at: Transform | None = None


class WrittenModels(NamedTuple):
    """What the carriers of a file say of the models that it was written of.

    `in_world` is whether these were in a world, None where that is as for any file: where it is False, several are in
    none, and what is around them belongs to the first. `by_tree` has the partial models by the names of their bodies at
    the top.
    """

    in_world: bool | None = None
    is_one: bool = False
    by_tree: Mapping[str, Model] = {}

    @classmethod
    def of(cls, texts: Collection[CarriedText]) -> Self:
        """Look at the carriers of a file."""
        nodes = [each.node for each in texts]
        models = [each for each in nodes if isinstance(each, Model)]
        by_tree = {name: each for each in models for name in annotated_trees(each)}
        is_one = any(find_annotation(each, SEVERAL) is not None for each in models)
        return cls(_is_in_world(texts, is_one=is_one, has_trees=bool(by_tree)), is_one, by_tree)

    def grouped(self, trees: Sequence[Piece]) -> list[ModelTrees]:
        """Return the models of a file, in the order of their first trees."""
        if self.is_one and len(trees) > 1:
            return [ModelTrees(tuple(trees), at=Transform())]
        found: dict[str, list[Piece]] = {}
        for place, tree in enumerate(trees):
            model = self.by_tree.get(tree.name or "")
            found.setdefault(f"named {model.name}" if model else f"unnamed {place}", []).append(tree)
        return [self._model(inside) for inside in found.values()]

    def _model(self, trees: Sequence[Piece]) -> ModelTrees:
        model = self.by_tree.get(trees[0].name or "")
        if model is None:
            return ModelTrees(tuple(trees))
        at = Transform.from_pose(model.pose) if len(trees) > 1 else None
        return ModelTrees(tuple(trees), model.name, at)


def _is_in_world(texts: Collection[CarriedText], *, is_one: bool, has_trees: bool) -> bool | None:
    """Whether carriers say that what the file has was in a world of SDF; None where none of them knows."""
    kinds = {each.kind: each.node for each in texts}
    if is_one:
        return False
    if has_trees or "world" in kinds:
        return True
    is_of_several = DOCUMENT in kinds and find_annotation(kinds[DOCUMENT], SEVERAL) is not None
    return False if are_of_sdf(texts) and not is_of_several else None
