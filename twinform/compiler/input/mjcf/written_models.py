"""Parts of edited models that MJCF has no words for: models and frames without a body, and joints that cannot move."""

from collections.abc import Iterable, Mapping

from twinform.compiler.input.mjcf.carried_texts import report_stale
from twinform.compiler.input.mjcf.pieces import pose_of
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Document, Frame, Joint, Model, World
from twinform.ir.transform import Transform
from twinform.passes.carriers.annotations import without_annotation
from twinform.passes.carriers.mjcf_texts import SEVERAL, TREE
from twinform.passes.carriers.partial_nodes import is_rest, written_name


def with_written_models(
    document: Document, partials: list[Model], sink: DiagnosticSink
) -> tuple[Document, list[Model]]:
    """Return the document with the models and frames of carriers, and what else these carriers hold of its models."""
    if not document.worlds:  # the only model is called as the file is
        names = [each.name for each in document.models]
        return document, [_bare(each.copy(name=name)) for each, name in zip(partials, names, strict=False)]
    world = document.worlds[0]
    known = {each.name for each in world.models}
    for each in partials:
        if each.name not in known and is_rest(each):
            report_stale(sink, f"there is no model {each.name!r} any more", each.source)
    whole = tuple(
        each.copy(frames=(), source=world.source) for each in partials if each.name not in known and not is_rest(each)
    )
    world = world.copy(models=(*world.models, *whole))
    world = _with_frames(world, {each.name: each for each in partials})
    return document.copy(worlds=(world, *document.worlds[1:])), [_bare(each) for each in partials if each.name in known]


def _bare(partial: Model) -> Model:
    """What is to be merged into a model: the file says where it is, and its frames have been found."""
    return without_annotation(partial, SEVERAL, TREE).copy(pose=None)


def _with_frames(world: World, partials: Mapping[str, Model]) -> World:
    """The world whose models have their frames that are sites of the world."""
    frames = {each.source.key if each.source else each.name: each for each in world.frames}

    def in_model(model: Model) -> Model:
        wanted = partials[model.name].frames if model.name in partials else ()
        at = Transform.from_pose(model.pose).inverse()
        found = [(each, frames.pop(written_name(each), None)) for each in wanted]
        moved = (_moved(frame, each.name, at) for each, frame in found if frame is not None)
        return model.copy(frames=(*model.frames, *moved)) if wanted else model

    models = tuple(map(in_model, world.models))
    return world.copy(models=models, frames=tuple(frames.values()))


def _moved(frame: Frame, name: str, into: Transform) -> Frame:
    """A frame of the world in a model, whose frame is the inverse of `into`."""
    return frame.copy(name=name, pose=pose_of(into.compose(Transform.from_pose(frame.pose)), source=frame.source))


def without_stand_ins(model: Model, partials: Iterable[Joint]) -> Model:
    """The model without the fixed joints that stand for those of static models, of which a file has bodies alone."""
    whole = (each for each in partials if each.type not in {"fixed", "gearbox"} and not is_rest(each))
    ends = {(each.parent, each.child) for each in whole}
    if not ends:
        return model
    kept = (each for each in model.joints if each.type != "fixed" or (each.parent, each.child) not in ends)
    return model.copy(joints=tuple(kept))
