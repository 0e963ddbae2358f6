"""A world whose parts no longer name frames inside its models, so that the models can go into other files.

A frame inside a model need not be there under its name in another format; the model itself and its links are.
"""

from dataclasses import dataclass

from twinform.diagnostics import Notes
from twinform.ir import Frame, Joint, Pose, World
from twinform.ir.frames import WORLD, FrameError, FrameGraph
from twinform.passes.legalise.nodes import map_poses

_INSIDE = "::"


def detach(world: World, notes: Notes) -> World:
    """The world with poses relative to whole models, and frames and joints on links."""
    graph = FrameGraph(world)
    names = frozenset(model.name for model in world.models)
    try:
        return _Detached(graph, names).world(world)
    except FrameError as error:
        error.report(notes)
        return world


@dataclass(frozen=True, slots=True)
class _Detached:
    graph: FrameGraph
    models: frozenset[str]

    def world(self, world: World) -> World:
        """All but the models, whose own poses are not theirs to keep."""
        frames = tuple(self._frame(frame) for frame in world.frames)
        joints = tuple(self._joint(joint) for joint in world.joints)
        rest = world.model_copy(update={"frames": frames, "joints": joints, "models": ()})
        models = tuple(model.model_copy(update={"pose": self._own(model.pose)}) for model in world.models)
        return map_poses(rest, self._pose).model_copy(update={"models": models})

    def _model_of(self, name: str | None) -> str | None:
        """The model that a name is inside of."""
        model, separator, _ = (name or "").partition(_INSIDE)
        return model if separator and model in self.models else None

    def _own(self, pose: Pose | None) -> Pose | None:
        return self._pose(pose) if pose is not None else None

    def _pose(self, pose: Pose) -> Pose:
        model = self._model_of(pose.relative_to)
        if model is None:
            return pose
        return self.graph.resolve(pose, WORLD, model, base="model").to_pose(model)

    def _frame(self, frame: Frame) -> Frame:
        model = self._model_of(frame.attached_to)
        if model is None or frame.attached_to is None:
            return frame
        body = self.graph.body(frame.attached_to)
        placed = self.graph.resolve(frame.pose, frame.attached_to, model, base="model").to_pose(model)
        return frame.model_copy(update={"attached_to": body, "pose": placed})

    def _joint(self, joint: Joint) -> Joint:
        update: dict[str, object] = {}
        for end, name in (("parent", joint.parent), ("child", joint.child)):
            if name is not None and self._model_of(name) is not None:
                update[end] = self.graph.body(name)
        model = self._model_of(joint.child)
        if model is not None and joint.child is not None and not (joint.pose and joint.pose.relative_to):
            update["pose"] = self.graph.resolve(joint.pose, joint.child, model, base="model").to_pose(model)
        return joint.model_copy(update=update) if update else joint
