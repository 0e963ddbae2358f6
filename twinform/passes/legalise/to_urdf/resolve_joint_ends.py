"""Joints of URDF connect links."""

from typing import ClassVar

from twinform.diagnostics.rules import model as model_rules
from twinform.diagnostics.rules import to_urdf as rules
from twinform.ir import Joint, Model, Opaque, Pose
from twinform.ir.frames import WORLD, FrameGraph
from twinform.passes.legalise.to_urdf.base import ToUrdfPass
from twinform.passes.legalise.to_urdf.keeper import Keeper
from twinform.passes.legalise.to_urdf.nodes import text_piece


class ResolveJointEnds(ToUrdfPass):
    """Let every joint connect the links that the frames at its ends move with.

    Changes: a parent or child that is a frame, a nested model or `__model__`. The joint stays where it is: its pose
    names the frame that it was relative to.
    Diagnostics: `self-joint` where both ends move with one link; in the ledger `joint-end`.
    """

    name: ClassVar[str] = "resolve-joint-ends"

    def run_model(self, model: Model, keeper: Keeper) -> Model:
        """The model with joints between links."""
        links = {link.name for link in model.links} | {WORLD}
        if all(joint.parent in links and joint.child in links for joint in model.joints):
            return model
        graph = FrameGraph(model)
        return model.model_copy(
            update={"joints": tuple(_resolve(joint, links, graph, keeper) for joint in model.joints)}
        )


def _resolve(joint: Joint, links: set[str], graph: FrameGraph, keeper: Keeper) -> Joint:
    changed: dict[str, object] = {}
    pieces: list[Opaque] = []
    for end, name in (("parent", joint.parent), ("child", joint.child)):
        if name is not None and name not in links:
            changed[end] = graph.body(name, source=joint.source)
            pieces.append(text_piece(end, name))
    if not changed:
        return joint
    if "child" in changed and not (joint.pose and joint.pose.relative_to):
        changed["pose"] = (joint.pose or Pose()).model_copy(update={"relative_to": joint.child})
    resolved = joint.model_copy(update=changed)
    if resolved.parent == resolved.child:
        message = f"both ends of joint {joint.name!r} move with link {resolved.child!r}"
        keeper.notes.report(model_rules.SELF_JOINT, message, joint.location, found=joint.child)
        return joint
    ends = " and ".join(repr(part.element.text) for part in pieces if part.element)
    message = f"joint {joint.name!r} connects the links that {ends} moves with"
    return keeper.keep(resolved, pieces, rules.JOINT_END, message, joint.location)
