"""Flattening of nested models into the outermost one."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from twinform.ir import IN_MODELS, Frame, Joint, Link, Model, Pose, ReferenceKind
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.passes.carriers.annotations import annotate_synthesized
from twinform.passes.transforms.element_poses import map_frames

Part = TypeVar("Part", Link, Joint, Frame)


def flatten(model: Model, keep: Callable[[Frame, Model], Frame]) -> Model:
    """The model with the links, joints and frames of its nested models, by their scoped names.

    A frame stands for each nested model's own; `keep` may put what else the model has there.
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
    """The names of one model, as they are called in the outermost one."""

    prefix: str

    def rename(self, kind: ReferenceKind, name: str) -> str:
        if kind not in IN_MODELS or name == WORLD:
            return name
        return self.frame_name if name == MODEL else self.prefix + name

    @property
    def frame_name(self) -> str:
        """What the model's own frame is called."""
        return self.prefix.removesuffix("::") or MODEL

    def link(self, link: Link) -> Link:
        pose = link.pose or Pose()
        return self._renamed(link, {"pose": pose.copy(relative_to=pose.relative_to or MODEL)})

    def joint(self, joint: Joint) -> Joint:
        return self._renamed(joint, {})

    def frame(self, frame: Frame) -> Frame:
        return self._renamed(frame, {"attached_to": frame.attached_to or MODEL})

    def _renamed(self, node: Part, update: dict[str, object]) -> Part:
        placed = node.copy(**{"name": self.prefix + node.name, **update})
        return map_frames(placed, self.rename)


def _own_frame(model: Model, around: _FlattenedNames, scope: _FlattenedNames, graph: FrameGraph) -> Frame:
    """The frame that stands for a nested model."""
    name = scope.frame_name
    body = graph.body(name, kind="model")
    base = around.rename("any", (model.pose and model.pose.relative_to) or MODEL)
    pose = (model.pose or Pose()).copy(relative_to=base)
    if model.placement_frame:
        pose = graph.pose(name, base, kind="model", base="joint").to_pose(base)
    # SDF attaches a model's frame to its canonical link. A model without links, or one that only
    # holds includes which were not read, has none.
    attached = body if graph.knows(body) and body not in (name, MODEL) else around.frame_name
    return annotate_synthesized(Frame(name=name, attached_to=attached, pose=pose, source=model.source))
