"""Nested models: made of names such as `arm::hand` since SDF 1.8, and flattened before 1.5."""

from collections import defaultdict
from dataclasses import field
from functools import partial
from typing import ClassVar, TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Fate, rules
from twinform.ir import (
    IN_MODELS,
    Axis,
    Document,
    Format,
    Frame,
    Joint,
    Link,
    Model,
    Pose,
    ReferenceKind,
    World,
    count_parts,
    map_references,
    rewrite,
)
from twinform.ir.defaults import direction
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.ir.scopes import SCOPE, scopes_of
from twinform.passes.carriers.annotations import without_synthesized
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.passes.shared.flattening import flatten
from twinform.passes.shared.nodes import piece
from twinform.schemas import parse_version

Part = TypeVar("Part", Link, Joint, Frame)


class NestModels(VersionPass):
    """Make nested models of links, joints, frames and models that were flattened into the model with scoped names.

    Changes: 1. `arm::hand` becomes `hand` in a model `arm`, whose frame is that of `arm::__model__` where there is one
    and else that of the model around it; everything stays where it is; 2. what names them does so too. A joint between
    one of them and a part of another model stays outside, with `_` for `::` in its name.
    Diagnostics: in the ledger `other-words`.
    """

    name: ClassVar[str] = "nest-models"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document without scoped names."""
        return rewrite(document, Model, lambda model: nest(model, keeper.sink))


@dataclass(slots=True)
class _Inner:
    """What goes into one nested model."""

    name: str
    links: list[Link] = field(default_factory=list[Link])
    joints: list[Joint] = field(default_factory=list[Joint])
    frames: list[Frame] = field(default_factory=list[Frame])
    models: list[Model] = field(default_factory=list[Model])
    own: Frame | None = None

    @property
    def prefix(self) -> str:
        return self.name + SCOPE

    @property
    def holds_anything(self) -> bool:
        return bool(self.links or self.joints or self.frames or self.models)

    def strip(self, name: str | None) -> str | None:
        """A name of the outer model as one of this."""
        return name.removeprefix(self.prefix) if name else name

    def holds(self, name: str | None) -> bool:
        """Whether a name of the outer model is one of this."""
        return bool(name) and (name or "").startswith(self.prefix)

    def joint_is_inside(self, joint: Joint) -> bool:
        leaders = (axis.mimic.joint for axis in (joint.axis, joint.axis2) if axis and axis.mimic)
        ends = all(end == WORLD or self.holds(end) for end in (joint.parent, joint.child))
        return ends and all(self.holds(leader) for leader in leaders)

    def moved(self, node: Part, update: dict[str, object]) -> Part:
        """A part of the outer model as one of this; what it names here it names by its new name."""
        return map_references(node.copy(**{"name": self.strip(node.name), **update}), self.follow)

    def follow(self, kind: ReferenceKind, name: str) -> str:
        return name.removeprefix(self.prefix) if kind in IN_MODELS else name


def nest(model: Model, sink: DiagnosticSink, among: frozenset[str] | None = None) -> Model:
    """The model with nested models of what has scoped names in it.

    `among` are the full names of the models that there are to be; None makes one of every scope.
    """
    named = (*model.links, *model.joints, *model.frames, *model.models)
    if not any(SCOPE in node.name for node in named):
        return model
    graph = FrameGraph(model)
    first = partial(_outermost_scope, among)
    inner = {name: _Inner(name) for node in named if (name := first(node.name))}
    links, joints, frames = list[Link](), list[Joint](), list[Frame]()
    for link in model.links:
        (inner[name].links if (name := first(link.name)) else links).append(link)
    for joint in model.joints:
        name = first(joint.name)
        if name and inner[name].joint_is_inside(joint):
            inner[name].joints.append(joint)
        else:
            # Since 1.8 `::` in a name is an error, and a joint between two models belongs to
            # neither.
            joints.append(joint.copy(name=joint.name.replace(SCOPE, "_")) if name else joint)
    for frame in model.frames:
        name = first(frame.name)
        if not name:
            frames.append(frame)
        elif frame.name == f"{name}{SCOPE}{MODEL}":
            inner[name].own = frame
        else:
            inner[name].frames.append(frame)
    models = [nested for nested in model.models if not first(nested.name)]
    for nested in model.models:
        if name := first(nested.name):
            inner[name].models.append(nested)
    inside = None if among is None else _scopes_inside(among)
    made = {
        each.name: _make_model(each, model, graph, sink, None if inside is None else frozenset(inside[each.name]))
        for each in inner.values()
        if each.holds_anything or (among is not None and each.own is not None)  # a static model may be empty
    }
    there = tuple(_add_found(nested, made.get(nested.name)) for nested in models)
    known = {each.name for each in models}
    new = tuple(nested for nested in made.values() if nested.name not in known)
    update = {"links": tuple(links), "joints": tuple(joints), "frames": tuple(frames), "models": (*there, *new)}
    return model.copy(**update)


def _outermost_scope(among: frozenset[str] | None, name: str) -> str:
    """The model that a scoped name begins with."""
    if among is None:
        return name.partition(SCOPE)[0] if SCOPE in name else ""
    return next((path for path in scopes_of(name) if path in among), "")


def _scopes_inside(among: frozenset[str]) -> dict[str, list[str]]:
    """The models that are to be in each of the outermost ones, by their names in that."""
    inside = defaultdict[str, list[str]](list)
    for path in among:
        if outermost := _outermost_scope(among, path):
            inside[outermost].append(path.removeprefix(outermost + SCOPE))
    return inside


def _make_model(
    inner: _Inner, around: Model, graph: FrameGraph, sink: DiagnosticSink, among: frozenset[str] | None
) -> Model:
    own, base = inner.own, MODEL
    pose = canonical = None
    if own is not None:
        base = own.name
        pose = own.pose
        frame = (pose.relative_to if pose else None) or own.attached_to
        if inner.holds(frame) or not inner.holds_anything:
            pose = graph.pose(own.name, MODEL, kind="frame").to_pose()
        elif frame:
            pose = (pose or Pose.unchecked()).copy(relative_to=frame)
        canonical = inner.strip(own.attached_to) if inner.holds(own.attached_to) else None
    nested = Model.unchecked(
        name=inner.name,
        pose=pose,
        canonical_link=canonical,
        links=tuple(_move_link(link, inner, base, graph) for link in inner.links),
        joints=tuple(_move_joint(joint, inner, graph) for joint in inner.joints),
        frames=tuple(_move_frame(frame, inner, base, graph) for frame in inner.frames),
        models=tuple(_move_model(nested, inner, base, graph) for nested in inner.models),
        source=next((each.source for each in (*inner.links, *inner.frames, *inner.joints)), around.source),
    )
    message = f"{len(nested.links)} links, {len(nested.joints)} joints and {len(nested.frames)} frames of model "
    message += f"{around.name!r} are in its nested model {inner.name!r}"
    sink.account(Fate.APPROXIMATED, rules.OTHER_WORDS, message, nested.location, 0)
    return nest(nested, sink, among)


def _move_link(link: Link, inner: _Inner, base: str, graph: FrameGraph) -> Link:
    pose = link.pose
    if not inner.holds(pose.relative_to if pose else None) and (base != MODEL or (pose and pose.relative_to)):
        pose = graph.pose(link.name, base, base="frame").to_pose()
    return inner.moved(link, {"pose": pose})


def _move_model(model: Model, inner: _Inner, base: str, graph: FrameGraph) -> Model:
    pose = model.pose
    if not inner.holds(pose.relative_to if pose else None) and (base != MODEL or (pose and pose.relative_to)):
        where = graph.pose(model.name, base, kind="model", base="frame")
        pose = where.to_pose()  # of the model's own frame, which a placement frame would move
        model = model.copy(placement_frame=None)
    pose = pose and map_references(pose, inner.follow)
    return model.copy(name=inner.strip(model.name), pose=pose)


def _move_frame(frame: Frame, inner: _Inner, base: str, graph: FrameGraph) -> Frame:
    pose, held = frame.pose, inner.holds(frame.attached_to)
    around = (pose.relative_to if pose else None) or frame.attached_to
    if not inner.holds(around):
        pose = graph.pose(frame.name, base, kind="frame", base="frame").to_pose(MODEL)
    # A model in a model cannot name a frame of the one around it, so the frame is attached to the
    # link that it moves with.
    held_by = frame.attached_to if held else graph.body(frame.name, kind="frame")
    return inner.moved(frame, {"attached_to": held_by if inner.holds(held_by) else None, "pose": pose})


def _move_joint(joint: Joint, inner: _Inner, graph: FrameGraph) -> Joint:
    pose = joint.pose
    if pose is not None and pose.relative_to and not inner.holds(pose.relative_to):
        pose = graph.pose(joint.name, joint.child or "", kind="joint").to_pose()
    axes = {field: _move_axis(joint, getattr(joint, field), inner, graph) for field in ("axis", "axis2")}
    return inner.moved(joint, {"pose": pose, **axes})


def _move_axis(joint: Joint, axis: Axis | None, inner: _Inner, graph: FrameGraph) -> Axis | None:
    """The axis, turned into the joint where the frame that it is expressed in is outside."""
    if axis is None or not axis.expressed_in or inner.holds(axis.expressed_in):
        return axis
    if axis.expressed_in == MODEL and inner.own is None:
        return axis
    turn = graph.pose(axis.expressed_in, joint.name, kind="frame", base="joint")
    return axis.copy(xyz=turn.rotate(direction(axis, Format.SDF)), expressed_in=None)


def _add_found(nested: Model, found: Model | None) -> Model:
    """A nested model that was there already, with what was found of it in the model around it."""
    if found is None:
        return nested
    update = {name: (*getattr(nested, name), *getattr(found, name)) for name in ("links", "joints", "frames", "models")}
    return nested.copy(**update)


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
