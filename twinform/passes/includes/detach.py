"""Resolves references from a world into its models, so that the models can be split into files of their own.

A frame inside of a model may not exist in another format; the model itself and its links do.
"""

from collections.abc import Mapping
from contextlib import suppress

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink
from twinform.ir import Frame, Joint, Pose, World, rewrite
from twinform.ir.frames import WORLD, FrameError, FrameGraph

_INSIDE = "::"


def detach(world: World, bases: Mapping[str, str], sink: DiagnosticSink) -> World:
    """The world with poses, frames and joints that refer to no frame inside of a model except its base.

    `bases` are these frames by the names of models: the model itself, or, where its own frame is elsewhere in the other
    format, a link such as `cart::base`. Frames and joints are attached to links.
    """
    try:
        return _Detacher(FrameGraph(world), bases).world(world)
    except FrameError as error:
        error.report(sink)
        return world


@dataclass(frozen=True, slots=True)
class _Detacher:
    graph: FrameGraph
    bases: Mapping[str, str]

    def world(self, world: World) -> World:
        """The world with all references into its models resolved."""
        frames = tuple(self._resolve_frame(frame) for frame in world.frames)
        joints = tuple(self._resolve_joint(joint) for joint in world.joints)
        rest = world.copy(frames=frames, joints=joints, models=())
        # Only where the model itself stands: poses in it name its own frames, which go with it into
        # its file.
        models = tuple(model.copy(pose=self._resolve_own_pose(model.pose)) for model in world.models)
        return rewrite(rest, Pose, self._resolve_pose).copy(models=models)

    def _base_for(self, name: str | None) -> str | None:
        """The base of the model that a name is, or is inside of; None where the name may stay."""
        model, inside, _ = (name or "").partition(_INSIDE)
        base = self.bases.get(model)
        return None if base is None or name == base or (not inside and base == model) else base

    def _relative(self, pose: Pose | None, holder: str, base: str) -> Pose:
        kind = "link" if _INSIDE in base else "model"
        return self.graph.resolve(pose, holder, base, base=kind).to_pose(base)

    def _resolve_own_pose(self, pose: Pose | None) -> Pose | None:
        return self._resolve_pose(pose) if pose is not None else None

    def _resolve_pose(self, pose: Pose) -> Pose:
        base = self._base_for(pose.relative_to)
        return pose if base is None else self._relative(pose, WORLD, base)

    def _resolve_frame(self, frame: Frame) -> Frame:
        base = self._base_for(frame.attached_to)
        if base is None or frame.attached_to is None:
            return frame
        # Links keep their names in URDF, frames of the model may not; so frames and joints of the
        # world hold on to links.
        body = self.graph.body(frame.attached_to)
        placed = self._relative(frame.pose, frame.attached_to, base)
        return frame.copy(attached_to=body, pose=placed)

    def _resolve_joint(self, joint: Joint) -> Joint:
        update: dict[str, object] = {}
        for end, name in (("parent", joint.parent), ("child", joint.child)):
            if name is not None and self._base_for(name) is not None:
                update[end] = self.graph.body(name)
        base = self._base_for(joint.child)
        if base is not None and joint.child is not None and not (joint.pose and joint.pose.relative_to):
            update["pose"] = self._relative(joint.pose, joint.child, base)
        return joint.copy(**update) if update else joint


def links_named_around(world: World) -> dict[str, frozenset[str]]:
    """The links that frames and joints of a world move with, by model."""
    graph = FrameGraph(world)
    names = [frame.attached_to for frame in world.frames]
    names += [end for joint in world.joints for end in (joint.parent, joint.child)]
    found: dict[str, set[str]] = {}
    for name in names:
        with suppress(FrameError):  # it may be in an include that was not read
            model, _, link = (graph.body(name) if name else "").partition(_INSIDE)
            found.setdefault(model, set()).add(link)
    return {model: frozenset(links) for model, links in found.items()}
