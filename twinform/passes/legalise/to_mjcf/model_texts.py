"""Carriers of models and worlds that were read of MJCF: what an edit of their SDF has given them, or made of them.

A file says of a model which links touch and which move, and of which trees of bodies it is. The rest has a text: its
plugins, frames beside its links, its name if its trees have another one, and that it is static or not.
"""

from collections.abc import Iterator
from typing import NamedTuple

from twinform.ir import Frame, Model, Node, Opaque
from twinform.ir.frames import WORLD
from twinform.ir.scopes import SCOPE
from twinform.passes.carriers.annotations import MADE_NAME, annotation, find_annotation, is_annotation, with_annotation
from twinform.passes.carriers.carriers import is_carrier, is_ours, without_parts
from twinform.passes.carriers.mjcf_texts import SEVERAL, TREE
from twinform.passes.carriers.partial_nodes import REST, WRITTEN, is_bare, remainder
from twinform.passes.carriers.said_by_mjcf import said_by_mjcf
from twinform.passes.legalise.to_mjcf.file_models import FileModels
from twinform.passes.legalise.to_mjcf.kept_mjcf import is_shape, kept_elements
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext
from twinform.passes.legalise.to_mjcf.written_file import WrittenFile
from twinform.passes.legalise.to_sdf.joint_types import FLOATING

_PARTS = {"links": (), "joints": (), "frames": (), "models": (), "pose": None}
"""The fields of a model that have texts of their own, or that the file says."""


class PartialHolder(NamedTuple):
    """The partial node of a model or world with its kind and name, and the node itself."""

    kind: str
    name: str
    left: Node
    node: Node


def holder_partials(context: MjcfContext, file: WrittenFile, models: FileModels) -> Iterator[PartialHolder]:
    """Yield what a file leaves unsaid of its world and of the models in it. All sections but `custom` are complete."""
    if isinstance(context.holder, Model):
        left = _left_of(file.flat, "", models, context)
        if len(models.trees("")) > 1:
            left = with_annotation(left, SEVERAL)
        elif is_bare(left):
            return
        yield PartialHolder("model", file.flat.name, left, file.flat)
        return
    for each in context.holder.models:
        left = _left_in_world(each, models, context)
        if left is not None:
            yield PartialHolder("model", each.name, left, each)


def _left_in_world(model: Model, models: FileModels, context: MjcfContext) -> Model | None:
    """What the file does not say of a model in a world; None where it says everything."""
    scope = model.name + SCOPE
    frames = tuple(_frames_beside(scope, models, context))
    if not models.is_written(scope):
        return model.copy(frames=frames)
    left = _left_of(model, scope, models, context)
    trees = models.keep_names(scope) if not models.are_said else ()
    if trees:
        notes = [annotation(TREE, attributes={"body": each}) for each in trees]
        if find_annotation(model, MADE_NAME) is not None:  # the shapes of the world, which are those of a body now
            notes.append(annotation(MADE_NAME, model.name))
        pose = model.pose if len(trees) > 1 else None
        return left.copy(pose=pose, frames=frames, opaque=(*notes, *left.opaque))
    return left.copy(frames=frames) if frames or not is_bare(left) else None


def _left_of(model: Model, scope: str, models: FileModels, context: MjcfContext) -> Model:
    """What the file does not say of a model, of what stands in the model itself."""
    is_still, name = models.is_still(scope), scope.removesuffix(SCOPE)
    told = model.copy(
        **_PARTS,
        self_collide=_touches_beside(model, name, context, is_still=is_still),
        static=None if bool(model.static) == is_still else bool(model.static),
    )
    return remainder(without_parts(told, is_of_mjcf), said_by_mjcf) or Model.unchecked(name=model.name)


def _touches_beside(model: Model, name: str, context: MjcfContext, *, is_still: bool) -> bool | None:
    """Whether a model touches itself; None where that is what the bits in the file say."""
    could_touch = context.contacts.could_touch_itself(name) or _keeps_what_touches(model)
    if model.self_collide and (is_still or not could_touch):
        return True
    # What stands still does not touch itself, whatever its bits are.
    return False if not is_still and context.contacts.is_told_apart(name) else None


def _keeps_what_touches(model: Model) -> bool:
    """Whether links keep geoms of MJCF that touch anything, of shapes that SDF does not have."""
    geoms = (each for link in model.links for each in kept_elements(link) if is_shape(each))
    return any((each.get("contype"), each.get("conaffinity")) != ("0", "0") for each in geoms)


def _frames_beside(scope: str, models: FileModels, context: MjcfContext) -> Iterator[Frame]:
    """Yield the frames of a model in a world that are sites of the world, by their names."""
    for link in (WORLD, models.ground):
        for name, frame in context.frames_by_link.get(link or "", ()):
            written = context.written_sites.get(name)
            if name.startswith(scope) and written is not None:
                notes = (annotation(REST), annotation(WRITTEN, attributes={"as": written}))
                yield Frame.unchecked(name=frame.name, opaque=notes)


def is_of_mjcf(part: Opaque) -> bool:
    """Whether an untyped part says how a file of MJCF is read; what URDF has, such as a floating joint, does not."""
    return is_ours(part) and not (is_carrier(part, "urdf") or is_annotation(part, FLOATING))
