"""Removing `<mimic>` from joints that a gearbox of SDF couples already."""

import math
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Joint, Mimic, Model
from twinform.ir.defaults import multiplier
from twinform.ir.frames import FrameError, FrameGraph
from twinform.passes.carriers.annotations import find_annotation, without_annotation
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.shared.joint_ends import GEARED, UngearedError, relation

_CLOSE = 1e-9
"""How far multipliers may be apart that were made from one ratio."""


class FoldGearboxes(ModelPass):
    """Take away the mimics that were synthesized for gearboxes in the conversion to URDF.

    Changes: a joint annotated as mimicking another for a gearbox does not, where a gearbox couples the two just so.
    Never touches: a mimic that was edited, or whose gearbox is gone; it stands for itself then.
    Diagnostics: `stale-carrier`.
    """

    name: ClassVar[str] = "fold-gearboxes"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with each coupling written once."""
        annotated = [
            joint for joint in model.joints if find_annotation(joint, GEARED) and joint.axis and joint.axis.mimic
        ]
        if not annotated:
            return model
        graph = FrameGraph(model)
        bare = {joint.name: _without_mimic(joint) for joint in annotated}
        # Without their mimics, as the joints stood when the gearbox was converted: a joint that
        # mimics cannot be geared.
        joints = {joint.name: bare.get(joint.name, joint) for joint in model.joints if joint.type != "gearbox"}
        gears = [joint for joint in model.joints if joint.type == "gearbox"]
        coupled: dict[str, Mimic] = {}
        for gearbox in gears:
            try:
                found = relation(gearbox, joints, graph)
            except (UngearedError, FrameError):
                continue
            coupled[found.follower] = Mimic.unchecked(joint=found.leader, multiplier=found.multiplier)
        kept = {
            joint.name: _with_needed_mimic(joint, bare[joint.name], coupled.get(joint.name), sink)
            for joint in annotated
        }
        return model.copy(joints=tuple(kept.get(joint.name, joint) for joint in model.joints))


def _without_mimic(joint: Joint) -> Joint:
    axis = joint.axis and joint.axis.copy(mimic=None)
    return without_annotation(joint.copy(axis=axis), GEARED)


def _with_needed_mimic(joint: Joint, bare: Joint, coupled: Mimic | None, sink: DiagnosticSink) -> Joint:
    """The joint without its mimic, if a gearbox expresses the same; else with it, as if it had always been there."""
    mimic = joint.axis.mimic if joint.axis else None
    if coupled and mimic and _is_the_same(mimic, coupled):
        return bare
    message = f"joint {joint.name!r} mimics {mimic.joint if mimic else None!r}, and no gearbox couples them so any more"
    sink.report(rules.STALE_CARRIER, message, joint.location, found=joint.name)
    return without_annotation(joint, GEARED)


def _is_the_same(mimic: Mimic, coupled: Mimic) -> bool:
    factors = (multiplier(mimic), coupled.multiplier or 0.0)
    return mimic.joint == coupled.joint and not mimic.offset and math.isclose(*factors, rel_tol=_CLOSE)
