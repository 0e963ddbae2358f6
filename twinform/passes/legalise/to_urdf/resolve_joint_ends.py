"""Resolving parent and child frames of joints to links."""

from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Joint, Model
from twinform.ir.frames import WORLD, FrameGraph
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.joint_ends import ENDS, named_ends, report_self_joint, resolve_ends


class ResolveJointEnds(ToUrdfPass):
    """Let every joint connect the links that the frames at its ends move with.

    Changes: a parent or child that is a frame, a nested model or `__model__`. The joint stays where it is: its pose
    names the frame that it was relative to.
    Diagnostics: `self-joint` where both ends move with one link; in the ledger `joint-end`.
    """

    name: ClassVar[str] = "resolve-joint-ends"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with joints between links."""
        links = {link.name for link in model.links} | {WORLD}
        if all(joint.parent in links and joint.child in links for joint in model.joints):
            return model
        graph = FrameGraph(model)
        return model.copy(joints=tuple(_resolve_joint(joint, links, graph, keeper) for joint in model.joints))


def _resolve_joint(joint: Joint, links: set[str], graph: FrameGraph, keeper: UrdfKeeper) -> Joint:
    resolved, pieces = resolve_ends(joint, links, graph)
    if not pieces:
        return joint
    if resolved.parent == resolved.child:
        report_self_joint(joint, resolved, keeper.sink)
        return joint
    message = f"joint {joint.name!r} is attached to {named_ends(pieces)}; what is written is the link that carries it"
    keeper.account(rules.JOINT_END, message, joint.location, sum(piece.weight for piece in pieces))
    ends = {piece.element.name: piece.element.text for piece in pieces if piece.element}
    return keeper.annotate(resolved, ENDS, attributes=ends)
