"""Models in models brought up into the outermost one."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

from twinform.ir import Axis, Element, Frame, Joint, Link, Model, Node, Pose, rewrite
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.passes.legalise.marks import mark_made
from twinform.passes.legalise.nodes import map_elements

AnyNode = TypeVar("AnyNode", bound=Node)
_FRAME_ATTRIBUTES = frozenset({"relative_to", "frame"})


def flatten(model: Model, keep: Callable[[Frame, Model], Frame]) -> Model:
    """The model with the links, joints and frames of its nested models, by their scoped names.

    A frame stands for each nested model's own; `keep` may put what else the model says there.
    """
    graph = FrameGraph(model)
    links, joints, frames = list(model.links), list(model.joints), list(model.frames)
    stack = [(nested, _Scope("")) for nested in reversed(model.models)]
    while stack:
        nested, around = stack.pop()
        scope = _Scope(f"{around.prefix}{nested.name}::")
        emptied = {"links": (), "joints": (), "frames": (), "models": ()}
        frames.append(keep(_own_frame(nested, around, scope, graph), nested.model_copy(update=emptied)))
        links.extend(scope.link(link) for link in nested.links)
        joints.extend(scope.joint(joint) for joint in nested.joints)
        frames.extend(scope.frame(frame) for frame in nested.frames)
        stack.extend((inner, scope) for inner in reversed(nested.models))
    update = {"links": tuple(links), "joints": tuple(joints), "frames": tuple(frames), "models": ()}
    return model.model_copy(update=update)


@dataclass(frozen=True, slots=True)
class _Scope:
    """The names of one model, as they are called in the outermost one."""

    prefix: str

    def rename(self, name: str | None) -> str | None:
        if not name or name == WORLD:
            return name
        if name == MODEL:
            return self.frame_name
        return self.prefix + name

    @property
    def frame_name(self) -> str:
        """What the model's own frame is called."""
        return self.prefix.removesuffix("::") or MODEL

    def link(self, link: Link) -> Link:
        pose = self._pose(link.pose) if link.pose else Pose()
        if pose.relative_to is None:
            pose = pose.model_copy(update={"relative_to": self.frame_name})
        inside = self._inside(link.model_copy(update={"pose": None}))
        update: dict[str, object] = {"name": self.prefix + link.name, "pose": pose}
        return inside.model_copy(update=update)

    def joint(self, joint: Joint) -> Joint:
        update: dict[str, object] = {
            "name": self.prefix + joint.name,
            "parent": self.rename(joint.parent),
            "child": self.rename(joint.child),
            "gearbox_reference_body": self.rename(joint.gearbox_reference_body),
            "axis": self._axis(joint.axis),
            "axis2": self._axis(joint.axis2),
        }
        return self._inside(joint).model_copy(update=update)

    def frame(self, frame: Frame) -> Frame:
        holder = self.rename(frame.attached_to or MODEL)
        update: dict[str, object] = {"name": self.prefix + frame.name, "attached_to": holder}
        return self._inside(frame).model_copy(update=update)

    def _axis(self, axis: Axis | None) -> Axis | None:
        if axis is None:
            return None
        update: dict[str, object] = {"expressed_in": self.rename(axis.expressed_in)}
        if axis.mimic is not None:
            update["mimic"] = axis.mimic.model_copy(update={"joint": self.rename(axis.mimic.joint)})
        return axis.model_copy(update=update)

    def _pose(self, pose: Pose) -> Pose:
        return pose.model_copy(update={"relative_to": self.rename(pose.relative_to)}) if pose.relative_to else pose

    def _inside(self, node: AnyNode) -> AnyNode:
        """The node with the frames renamed that poses in it name, in typed and in opaque parts."""
        node = rewrite(node, Pose, self._pose)
        return _map_opaque(node, self)


def _map_opaque(node: AnyNode, scope: _Scope) -> AnyNode:
    update: dict[str, object] = {}
    if node.opaque:
        update["opaque"] = map_elements(node.opaque, partial(_rename_in, scope))
    if isinstance(node, Link | Joint) and node.sensors:
        update["sensors"] = tuple(_map_opaque(sensor, scope) for sensor in node.sensors)
    return node.model_copy(update=update) if update else node


def _rename_in(scope: _Scope, element: Element) -> Element:
    attributes = element.attributes
    if element.name == "pose":
        attributes = tuple(
            (name, scope.rename(value) or "" if name in _FRAME_ATTRIBUTES else value) for name, value in attributes
        )
    children = tuple(_rename_in(scope, child) for child in element.children)
    return element.model_copy(update={"attributes": attributes, "children": children})


def _own_frame(model: Model, around: _Scope, scope: _Scope, graph: FrameGraph) -> Frame:
    """The frame that stands for a nested model."""
    name = scope.frame_name
    body = graph.body(name, kind="model")
    base = around.rename(model.pose.relative_to if model.pose and model.pose.relative_to else MODEL) or MODEL
    pose = (model.pose or Pose()).model_copy(update={"relative_to": base})
    if model.placement_frame:
        pose = graph.pose(name, base, kind="model", base="joint").to_pose(base)
    attached = body if graph.knows(body) and body not in (name, MODEL) else around.frame_name
    return mark_made(Frame(name=name, attached_to=attached, pose=pose, source=model.source))
