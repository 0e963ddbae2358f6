"""Flattening of nested models into the outermost one, and what a nested model holds of its links: settings, static."""

from collections.abc import Callable, Iterator
from typing import TypeVar

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import IN_MODELS, Frame, Joint, Link, Model, Pose, ReferenceKind
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.ir.kinematic_tree import KinematicTree
from twinform.ir.scopes import SCOPE
from twinform.passes.carriers.annotations import (
    annotate_synthesized,
    find_annotation,
    with_annotation,
    without_annotation,
)
from twinform.passes.shared.nodes import reserve_name
from twinform.passes.shared.poses import map_frames

Part = TypeVar("Part", Link, Joint, Frame)
_OF_LINKS = ("self_collide", "enable_wind")
_OWN = "own-settings"
"""The annotation on a link with the settings that it has itself and shares with its model."""


def flatten(model: Model, keep: Callable[[Frame, Model], Frame]) -> Model:
    """The model with the links, joints and frames of its nested models, by their scoped names.

    A frame replaces the frame of each nested model; `keep` may add what else the nested model has.
    """
    graph = FrameGraph(model)
    links, joints, frames = list(model.links), list(model.joints), list(model.frames)
    # A stack, not recursion: models may be nested as deeply as the reader allows.
    stack = [(nested, _FlattenedNames("")) for nested in reversed(model.models)]
    while stack:
        nested, around = stack.pop()
        scope = _FlattenedNames(f"{around.prefix}{nested.name}::")
        emptied = {"links": (), "joints": (), "frames": (), "models": ()}
        # A frame for each nested model: what is posed in the model's own frame needs one, and the
        # conversion back makes the model of it again.
        frames.append(keep(_own_frame(nested, around, scope, graph), nested.copy(**emptied)))
        links.extend(scope.link(link) for link in nested.links)
        joints.extend(scope.joint(joint) for joint in nested.joints)
        frames.extend(scope.frame(frame) for frame in nested.frames)
        stack.extend((inner, scope) for inner in reversed(nested.models))
    update = {"links": tuple(links), "joints": tuple(joints), "frames": tuple(frames), "models": ()}
    return model.copy(**update)


@dataclass(frozen=True, slots=True)
class _FlattenedNames:
    """Renames the parts of one nested model to their scoped names in the outermost one."""

    prefix: str

    def rename(self, kind: ReferenceKind, name: str) -> str:
        if kind not in IN_MODELS or name == WORLD:
            return name
        return self.frame_name if name == MODEL else self.prefix + name

    @property
    def frame_name(self) -> str:
        """The name of the frame of the model itself."""
        return self.prefix.removesuffix("::") or MODEL

    def link(self, link: Link) -> Link:
        pose = link.pose or Pose.unchecked()
        return self._renamed(link, {"pose": pose.copy(relative_to=pose.relative_to or MODEL)})

    def joint(self, joint: Joint) -> Joint:
        return self._renamed(joint, {})

    def frame(self, frame: Frame) -> Frame:
        return self._renamed(frame, {"attached_to": frame.attached_to or MODEL})

    def _renamed(self, node: Part, update: dict[str, object]) -> Part:
        placed = node.copy(**{"name": self.prefix + node.name, **update})
        return map_frames(placed, self.rename)


def _own_frame(model: Model, around: _FlattenedNames, scope: _FlattenedNames, graph: FrameGraph) -> Frame:
    """The frame that replaces the frame of a nested model."""
    name = scope.frame_name
    body = graph.body(name, kind="model")
    base = around.rename("any", (model.pose and model.pose.relative_to) or MODEL)
    pose = (model.pose or Pose.unchecked()).copy(relative_to=base)
    if model.placement_frame:
        pose = graph.pose(name, base, kind="model", base="joint").to_pose(base)
    # SDF attaches a model's frame to its canonical link. A model without links, or one that only
    # holds includes which were not read, has none.
    attached = body if graph.knows(body) and body not in (name, MODEL) else around.frame_name
    return annotate_synthesized(Frame.unchecked(name=name, attached_to=attached, pose=pose, source=model.source))


def settle_links(model: Model, *, annotated: bool = False) -> Model:
    """The model with the settings of nested models copied to their links."""
    models = (settle_links(_settle_links_of(inner, annotated=annotated), annotated=annotated) for inner in model.models)
    return model.copy(models=tuple(models))


def _settle_links_of(model: Model, *, annotated: bool) -> Model:
    settings = {field: value for field in _OF_LINKS if (value := getattr(model, field)) is not None}
    return model.copy(links=tuple(_settle_link(link, settings, annotated=annotated) for link in model.links))


def _settle_link(link: Link, settings: dict[str, bool], *, annotated: bool) -> Link:
    update = {field: value for field, value in settings.items() if getattr(link, field) is None}
    own = " ".join(field for field, value in settings.items() if getattr(link, field) == value)
    link = link.copy(**update) if update else link
    return with_annotation(link, _OWN, own) if annotated and own else link


def unsettle_links(model: Model, sink: DiagnosticSink) -> Model:
    """A nested model without the settings that `settle_links` copied to its links.

    A setting that one of the links lacks was deleted by an edit, and is removed from the model too.
    """
    for field in _OF_LINKS:
        value = getattr(model, field)
        if value is None:
            continue
        if any(getattr(link, field) is None for link in model.links):
            message = f"model {model.name!r} had {field}, and one of its links has none now"
            sink.report(STALE_CARRIER, message, model.location, found=field)
            model = model.copy(**{field: None})
        else:
            model = model.copy(links=tuple(_unsettle_link(link, field, value) for link in model.links))
    return model.copy(links=tuple(without_annotation(link, _OWN) for link in model.links))


def _unsettle_link(link: Link, field: str, value: bool) -> Link:
    own = find_annotation(link, _OWN)
    keeps = getattr(link, field) != value or (own is not None and field in (own.text or "").split())
    return link if keeps else link.copy(**{field: None})


def differing_rests(model: Model) -> Iterator[tuple[Model, str]]:
    """The nested models whose `allow_auto_disable` differs from that of the outermost one, with a message for each."""
    rests = model.allow_auto_disable is not False
    for nested in model.models:
        value = nested.allow_auto_disable
        if value is not None and value != rests:
            said = f"nested model {nested.name!r} sets allow_auto_disable to {str(value).lower()}"
            yield nested, f"{said}, and {model.name!r} does not"
        yield from differing_rests(nested.copy(allow_auto_disable=model.allow_auto_disable))


def with_static_models_fixed(model: Model) -> Model:
    """The model with a fixed joint to the world for each root link of its static nested models.

    The new joints come first. A model that is static itself is unchanged, since all in it is static anyway.

    Raises:
        FrameError: an end of a joint is not known, or frames go round in a circle.
    """
    # gz-sim hands <static> down: links of models in a static model are held whatever these say
    # themselves (SdfEntityCreator.cc, CreateEntities: `_model->Static() || _staticParent`). Drake
    # holds those of the nested model and leaves models in it free.
    roots = [] if model.static else [*_list_static_roots(model, "")]
    if not roots:
        return model
    taken = {node.name for node in (*model.links, *model.joints, *model.frames, *model.models)}
    welds: list[Joint] = []
    for root, nested in roots:
        name = reserve_name(f"{root.replace(SCOPE, '__')}_fixed_joint", taken)
        weld = Joint.unchecked(name=name, type="fixed", parent=WORLD, child=root, source=nested.source)
        welds.append(annotate_synthesized(weld))
    # Joints between the links stay, as in a model that is static as a whole: URDF is a tree, and
    # they place the links.
    return model.copy(joints=(*welds, *model.joints))


def _list_static_roots(model: Model, scope: str) -> Iterator[tuple[str, Model]]:
    """The root links of static nested models, by their scoped names, with the nested model."""
    for nested in model.models:
        inside = f"{scope}{nested.name}{SCOPE}"
        if not nested.static:
            yield from _list_static_roots(nested, inside)
            continue
        tree = KinematicTree(nested)
        yield from ((inside + name, nested) for name in tree.links if tree.joint_above(name) is None)
