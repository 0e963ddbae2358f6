"""Nested models of SDF: flattened for URDF, and made again of scoped names."""

from collections.abc import Iterable
from functools import partial
from typing import ClassVar, TypeVar

from twinform.diagnostics import DiagnosticSink, Fate, Severity, rules
from twinform.diagnostics.rules import NESTED_MODEL, STALE_CARRIER
from twinform.ir import IN_MODELS, Element, Format, Frame, Link, Model, Node, Opaque, Pose, count_parts, map_references
from twinform.ir.frames import MODEL, FrameError, FrameGraph
from twinform.ir.scopes import SCOPE, nested_models, nested_names, scopes_of
from twinform.ir.transform import Transform
from twinform.passes.carriers.absorb import CarrierError, absorb
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation, wrote_scopes
from twinform.passes.carriers.carriers import NAMESPACE, to_element
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.changed_names import Names, renamed, with_old_names
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.sdf_versions.nest_models import nest
from twinform.passes.shared.flattening import (
    differing_rests,
    flatten,
    settle_links,
    unsettle_links,
    with_static_models_fixed,
)
from twinform.passes.shared.nodes import reserve_name
from twinform.passes.shared.poses import NESTED, POSE, pose_attributes


class FlattenForUrdf(ToUrdfPass):
    """Bring the links, joints and frames of nested models up into the model.

    Changes: 1. they are called `inner__name`, and what names them does so too, also where a file before 1.8 calls its
    parts `inner::name` without a model of that name; 2. a frame called `inner` stands for the
    nested model's own frame, and poses that were relative to it name it; 3. the roots in a static one are fixed to the
    world; 4. its `self_collide` and `enable_wind` are also those of its links, which Gazebo reads; 5. all else that the
    nested model has is carried on that frame.
    Diagnostics: `include-not-expanded` for includes in any of the models; in the ledger `nested-model`, and
    `nested-setting` where a nested model may rest and the outer one may not, or the other way round.
    """

    name: ClassVar[str] = "flatten-for-urdf"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model without models in it."""
        _refuse_includes(model, keeper)
        if keeper.sink.has_errors:
            return model
        flat = flat_model(model, keeper) if model.models else model
        names = _legal_names(flat)
        if not names:
            return flat
        flat = renamed(flat, names, Format.SDF)
        return with_old_names(flat, names) if keeper.carriers else flat


def flat_model(model: Model, keeper: UrdfKeeper) -> Model:
    """The model without models in it: their parts have scoped names, and annotated frames stand for the models."""
    for nested, message in differing_rests(model):
        where = nested.location.at("allow_auto_disable")
        keeper.sink.account(Fate.APPROXIMATED, rules.NESTED_SETTING, f"{message}: Gazebo reads the outer one", where, 0)
    settled = settle_links(model, annotated=keeper.carriers)
    return flatten(with_static_models_fixed(settled), partial(_keep_settings, keeper))


def _keep_settings(keeper: UrdfKeeper, frame: Frame, shell: Model) -> Frame:
    """The frame of a nested model with all else that the model has; its pose is the frame's."""
    message = f"nested model {frame.name!r} is flattened"
    keeper.account(rules.NESTED_MODEL, message, shell.location, count_parts(shell))
    if not keeper.carriers:
        return frame
    own = to_element(shell.copy(pose=None), "model", "sdf")
    attributes = tuple(pair for pair in own.attributes if pair[0] != "name")
    annotation = own.copy(name=f"{{{NAMESPACE}}}{NESTED}", attributes=attributes)
    frame = frame.copy(opaque=(*frame.opaque, Opaque.unchecked(element=annotation)))
    written = pose_attributes(shell.pose)
    if "relative_to" in written and frame.pose:
        written["relative_to"] = frame.pose.relative_to  # by its name in the outermost model
    return with_annotation(frame, POSE, attributes=written) if written else frame


def _legal_names(model: Model) -> Names:
    """What the parts of nested models are called in URDF, whose readers take `::` for something else."""
    taken = {node.name for field in ("links", "joints", "frames") for node in getattr(model, field)}
    names: Names = {}
    for part, field in (("link", "links"), ("joint", "joints"), ("frame", "frames")):
        for node in getattr(model, field):
            if SCOPE in node.name:
                # libsdformat refuses `::` in a URDF (it writes SDF of a version where that is a
                # scope).
                names[part, node.name] = reserve_name(node.name.replace(SCOPE, "__"), taken)
    return names


def _refuse_includes(model: Model, keeper: UrdfKeeper) -> None:
    for each in nested_models(model):
        for include in each.includes:
            message = f"model {each.name!r} includes {include.uri!r}, which was not read"
            keeper.sink.report(rules.INCLUDE_NOT_EXPANDED, message, include.location, found=include.uri)


AnyNode = TypeVar("AnyNode", bound=Node)

_OWN = f"{SCOPE}{MODEL}"


class NameScopes(ModelPass):
    """Call the frames that stand for nested models as SDF calls them: `inner` becomes `inner::__model__`.

    Changes: these frames, and what names them. One whose model has nothing in it any more, because names were changed,
    is a frame like others.
    Never touches: other frames.
    Diagnostics: `nested-model` where such a frame was fixed to a link outside of its model; `stale-carrier` where
    nothing is in the model.
    """

    name: ClassVar[str] = "name-scopes"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with the frames of nested models by their scoped names."""
        model = _without_hollow(model, sink)
        own = [frame for frame in model.frames if find_annotation(frame, NESTED) is not None]
        if not own:
            return model
        links = {link.name for link in model.links}
        filled = _scopes_with_any(links)
        for frame in own:
            if frame.name in filled:
                _report_outside(frame, links, sink)
        return renamed(model, {("frame", frame.name): f"{frame.name}{_OWN}" for frame in own}, Format.SDF)


def _without_hollow(model: Model, sink: DiagnosticSink) -> Model:
    """The model without annotations of nested models that nothing is in."""
    # a joint goes where its links are
    filled = _scopes_with_any(node.name for node in (*model.links, *model.frames))
    frames: list[Frame] = []
    for frame in model.frames:
        found = find_annotation(frame, NESTED)
        # Names tell what is in a nested model. After an edit that renamed all its parts an empty
        # model would be left, which SDF refuses unless it is static.
        if found is None or frame.name in filled or _was_empty(frame, found):
            frames.append(frame)
            continue
        message = f"nothing is called {frame.name + SCOPE!r} and more, so that {frame.name!r} is a frame and no model"
        sink.report(STALE_CARRIER, message, frame.location, found=frame.name)
        frames.append(without_annotation(frame, NESTED))
    return model.copy(frames=tuple(frames))


def _was_empty(frame: Frame, found: Element) -> bool:
    """Whether a static model had no link of its own to which its frame could be attached."""
    static = found.find("static")
    is_static = static is not None and static.text in {"true", "1"}
    return is_static and not (frame.attached_to or "").startswith(frame.name + SCOPE)


def _scopes_with_any(names: Iterable[str]) -> frozenset[str]:
    """The nested models that any of these names is in."""
    return frozenset(scope for name in names for scope in scopes_of(name))


def _report_outside(frame: Frame, links: set[str], sink: DiagnosticSink) -> None:
    """The frame of a nested model that has links moves with one of them."""
    holder = frame.attached_to or ""
    if holder in links and not holder.startswith(frame.name + SCOPE):
        message = f"link {frame.name!r} is the frame of a nested model in SDF, and is fixed to {holder!r} outside of it"
        sink.report(NESTED_MODEL, message, frame.location, found=holder, severity=Severity.ERROR)


class RestoreNested(ModelPass):
    """Put links, joints and frames with scoped names back into the models that SDF had inside the model.

    Changes: 1. `inner::link` is `link` in the model `inner`, and so on; 2. the model has again its other content. With
    `scopes`, a file before 1.8, where `::` may stand in any name, has such models by these names too, as since 1.8.
    Never touches: names without a scope, so what was added or renamed since stays where it is.
    Diagnostics: `stale-carrier` where what a nested model had does not fit it, `nested-model` where a frame of one
    moves with a link outside of it by now.
    """

    name: ClassVar[str] = "restore-nested"
    scopes: bool = False

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with the models in it."""
        annotated = {
            frame.name.removesuffix(_OWN): found for frame in model.frames if (found := find_annotation(frame, NESTED))
        }
        # Before 1.8 `::` may stand in any name. Such names come back whatever became of the frames;
        # since 1.8 they would be nested models.
        free = self.scopes and wrote_scopes(model)
        if not annotated and not free:
            return model
        try:
            _report_frames_outside(model, annotated, sink)
            # The findings of nesting are about a change of version; here it only restores what was.
            nested = nest(model, DiagnosticSink(), None if free else frozenset(annotated))
            models = tuple(_with_rest(inner, inner.name, annotated, sink) for inner in nested.models)
            return _tidy(nested.copy(models=models))
        except FrameError as error:
            error.report(sink)
            return model


def _report_frames_outside(model: Model, annotated: Iterable[str], sink: DiagnosticSink) -> None:
    """A frame in a nested model moves with a link of that model."""
    graph = FrameGraph(model)
    links = {link.name for link in model.links}
    filled = _scopes_with_any(links)
    order = {path: number for number, path in enumerate(annotated)}
    for frame in model.frames:
        path = min((path for path in scopes_of(frame.name) if path in order), key=order.__getitem__, default=None)
        if frame.name.endswith(_OWN) or path not in filled:
            continue
        body = graph.body(frame.name, kind="frame")
        if body in links and not body.startswith(path + SCOPE):
            message = f"frame {frame.name!r} is in a nested model, and is fixed to {body!r} outside of it"
            sink.report(NESTED_MODEL, message, frame.location, found=body, severity=Severity.ERROR)


def _with_rest(model: Model, path: str, annotated: dict[str, Element], sink: DiagnosticSink) -> Model:
    """A nested model with what it had besides its links, joints, frames and pose; and so those in it."""
    models = tuple(_with_rest(inner, f"{path}{SCOPE}{inner.name}", annotated, sink) for inner in model.models)
    model = model.copy(models=models)
    found = annotated.get(path)
    if found is None:
        return model
    pieces = (
        *(Opaque.unchecked(attribute=pair) for pair in found.attributes),
        *(Opaque.unchecked(element=child) for child in found.children),
    )
    try:
        whole = absorb(model.copy(canonical_link=None), pieces)
        return _posed_by_placement_frame(_with_known_links(unsettle_links(whole, sink)))
    except CarrierError as error:
        message = f"the carried content of nested model {path!r} does not fit it any more: {error}"
        sink.report(STALE_CARRIER, message, model.location, found=path)
        return model


def _with_known_links(model: Model) -> Model:
    """The model without a canonical link or a placement frame that is gone."""
    graph = FrameGraph(model)
    update = {
        field: None
        for field in ("canonical_link", "placement_frame")
        if (name := getattr(model, field)) is not None and not graph.knows(name)
    }
    return model.copy(**update) if update else model


def _posed_by_placement_frame(model: Model) -> Model:
    """The model posed by its placement frame, if it has one; it was posed by its own."""
    if model.placement_frame is None:
        return model
    inside = FrameGraph(model).pose(model.placement_frame, MODEL, kind="frame", base="model")
    around = model.pose.relative_to if model.pose else None
    return model.copy(pose=Transform.from_pose(model.pose).compose(inside).to_pose(around))


def _tidy(model: Model) -> Model:
    """The model without names that go without saying: its own frame, and that of a model by its full name."""
    models = frozenset(nested_names(model))
    model = map_references(model, lambda kind, name: _short(models, name) if kind in IN_MODELS else name)
    update = {
        "models": tuple(map(_tidy, model.models)),
        "links": tuple(map(_posed, model.links)),
        "frames": tuple(map(_attached, model.frames)),
    }
    return _posed(model.copy(**update))


def _posed(node: AnyNode) -> AnyNode:
    """The node without an empty pose, or a frame that is the usual one."""
    pose: Pose | None = getattr(node, "pose", None)
    if pose is None:
        return node
    own = pose.relative_to == MODEL and isinstance(node, Link | Model)
    pose = pose.copy(relative_to=None) if own else pose
    return node.copy(pose=None if pose == Pose.unchecked() else pose)


def _short(models: frozenset[str], name: str) -> str:
    """A name; that of a model for its own frame."""
    short = name.removesuffix(_OWN)
    return short if short in models else name


def _attached(frame: Frame) -> Frame:
    return frame.copy(attached_to=None) if frame.attached_to == MODEL else frame
