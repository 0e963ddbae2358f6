"""Poses as SDF had them before 1.7, when frames had no names."""

from typing import Any, ClassVar, TypeVar

from twinform.diagnostics import Fate, Notes
from twinform.diagnostics.rules import to_sdf
from twinform.ir import Collision, Frame, Joint, Light, Link, Model, Opaque, Pose, Sensor, Visual, count_parts
from twinform.ir.frames import MODEL, WORLD, FrameError, FrameGraph
from twinform.ir.transform import Transform
from twinform.passes.legalise.carrier import carry, to_element
from twinform.passes.legalise.model_pass import ModelPass

Placed = TypeVar("Placed", Visual, Collision, Sensor, Light)


class AbsolutePoses(ModelPass):
    """Give every pose in the one frame that SDF before 1.7 gives it in.

    Changes: 1. links are posed in the model; 2. joints in their child link; 3. visuals, collisions, sensors and lights
    in their link; 4. a joint's parent that is a frame becomes the link that the frame moves with; 5. frames go; 6. with
    `axes_in_model`, as before 1.5, axes are in the model.
    Never touches: poses that name no frame and have the right one already.
    Diagnostics: `older-version` for each frame, which is carried.
    """

    name: ClassVar[str] = "absolute-poses"
    carriers: bool = True
    axes_in_model: bool = False

    def run_model(self, model: Model, notes: Notes) -> Model:
        """The model without named frames."""
        graph = FrameGraph(model)
        try:
            links = tuple(_link(link, graph) for link in model.links)
            joints = tuple(_joint(joint, graph, axes_in_model=self.axes_in_model) for joint in model.joints)
        except FrameError as error:
            error.report(notes)
            return model
        for frame in model.frames:
            self._account(frame, notes)
        frames = [Opaque(element=to_element(frame, "frame", "sdf")) for frame in model.frames]
        plain = model.model_copy(update={"links": links, "joints": joints, "frames": (), "canonical_link": None})
        return carry(plain, frames, "sdf") if self.carriers else plain

    def _account(self, frame: Frame, notes: Notes) -> None:
        message = f"frame {frame.name!r} has no place in SDF before 1.7"
        notes.report(to_sdf.OLDER_VERSION, message, frame.location, found=frame.name)
        fate = Fate.CARRIED if self.carriers else Fate.DROPPED
        notes.account(fate, to_sdf.OLDER_VERSION, message, frame.location, count_parts(frame))


def _link(link: Link, graph: FrameGraph) -> Link:
    update: dict[str, Any] = {"pose": _pose(link.pose, graph.pose(link.name, MODEL))}
    for field in ("visuals", "collisions", "sensors", "lights"):
        placed: tuple[Any, ...] = getattr(link, field)
        if any(one.pose and one.pose.relative_to for one in placed):
            update[field] = tuple(_placed(one, link, graph) for one in placed)
    return link.model_copy(update=update)


def _placed(node: Placed, link: Link, graph: FrameGraph) -> Placed:
    if node.pose is None or node.pose.relative_to is None:
        return node
    return node.model_copy(update={"pose": _pose(node.pose, graph.resolve(node.pose, link.name, link.name))})


def _joint(joint: Joint, graph: FrameGraph, *, axes_in_model: bool) -> Joint:
    update: dict[str, Any] = {}
    if axes_in_model and joint.axis and joint.axis.xyz:
        xyz = graph.pose(joint.name, MODEL, kind="joint").rotate(joint.axis.xyz)
        update["axis"] = joint.axis.model_copy(update={"xyz": xyz})
    if joint.child:
        update["pose"] = _pose(joint.pose, graph.pose(joint.name, joint.child, kind="joint"))
    if joint.parent and joint.parent != WORLD:
        update["parent"] = graph.body(joint.parent)
    return joint.model_copy(update=update)


def _pose(old: Pose | None, where: Transform) -> Pose | None:
    """The pose of a transform; None for the identity, where nothing needs to be written."""
    if where == Transform():
        return None
    return where.to_pose().model_copy(update={"source": old.source if old else None})
