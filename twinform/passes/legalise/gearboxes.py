"""Gearbox joints of SDF, which are `<mimic>` in URDF, and the way back."""

import math
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, Fate, Severity, rules
from twinform.ir import Axis, Joint, Mimic, Model, count_parts
from twinform.ir.defaults import multiplier
from twinform.ir.frames import FrameError, FrameGraph
from twinform.passes.carriers.annotations import find_annotation, with_annotation, without_annotation
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.cut_joints import cut_joints
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.joint_ends import GEARED, Relation, UngearedError, relation


class RelateGearboxes(ToUrdfPass):
    """Let one of the two joints that a gearbox couples mimic the other.

    Changes: 1. the joint between the reference body and the gearbox's child mimics the one between the reference body
    and its parent; 2. the gearbox itself, with all that it contains, is a `<joint>` in a `<gazebo>` element.
    Never touches: a joint that mimics another already.
    Diagnostics: `gearbox`, a warning where only Gazebo couples anything; in the ledger `gearbox`.
    """

    name: ClassVar[str] = "relate-gearboxes"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model without gearboxes."""
        gearboxes = [joint for joint in model.joints if joint.type == "gearbox"]
        if not gearboxes:
            return model
        graph = FrameGraph(model)
        joints = {joint.name: joint for joint in model.joints if joint.type != "gearbox"}
        for gearbox in gearboxes:
            try:
                found = relation(gearbox, joints, graph)
            except UngearedError as error:
                _report_uncoupled(gearbox, str(error), keeper)
                continue
            joints[found.follower] = _follower(joints[found.follower], found)
            # A gearbox couples two joints and holds no link, so it has no place in the tree. It
            # also goes along as a joint in <gazebo>, for Gazebo Classic, which does not know mimic.
            message = f"gearbox {gearbox.name!r}: joint {found.follower!r} mimics {found.leader!r}"
            _report(gearbox, message, Severity.INFO, keeper)
        holding = {joint.child or "": joint for joint in joints.values()}
        return cut_joints(model, tuple(joints.values()), gearboxes, holding, keeper)


def _follower(joint: Joint, found: Relation) -> Joint:
    mimic = Mimic.unchecked(joint=found.leader, multiplier=found.multiplier)
    axis = (joint.axis or Axis.unchecked()).copy(mimic=mimic)
    return with_annotation(joint.copy(axis=axis), GEARED)


def _report_uncoupled(gearbox: Joint, why: str, keeper: UrdfKeeper) -> None:
    message = f"gearbox {gearbox.name!r} cannot be written as a mimic in URDF: {why}"
    _report(gearbox, message, Severity.WARNING, keeper)


def _report(gearbox: Joint, message: str, severity: Severity, keeper: UrdfKeeper) -> None:
    keeper.sink.report(rules.GEARBOX, message, gearbox.location, found=gearbox.name, severity=severity)
    keeper.sink.account(Fate.CARRIED, rules.GEARBOX, message, gearbox.location, count_parts(gearbox))


_CLOSE = 1e-9
"""How far multipliers may be apart that were made from one ratio."""


_OF_ONE_AXIS = frozenset({"revolute", "continuous", "prismatic"})
"""The types of joints that MJCF couples."""


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


def without_their_mimics(model: Model, sink: DiagnosticSink) -> Model:
    """The model without the mimics that MJCF has for gearboxes, and without gearboxes for which it has none any more.

    Diagnostics: `stale-carrier`.
    """
    gears = [joint for joint in model.joints if joint.type == "gearbox"]
    if not gears:
        return model
    graph = FrameGraph(model)
    bare = {joint.name: _without_mimic(joint) for joint in model.joints if joint.type != "gearbox"}
    joints = {joint.name: joint for joint in model.joints}
    for gearbox in gears:
        try:
            found = relation(gearbox, bare, graph)
        except (UngearedError, FrameError):
            continue
        follower, leader = joints[found.follower], bare[found.leader]
        if not {follower.type, leader.type} <= _OF_ONE_AXIS:
            continue
        mimic = follower.axis.mimic if follower.axis else None
        if mimic and _is_the_same(mimic, Mimic.unchecked(joint=found.leader, multiplier=found.multiplier)):
            joints[found.follower] = bare[found.follower]
        else:
            message = (
                f"joint {found.follower!r} does not follow {found.leader!r} any more as gearbox {gearbox.name!r} says"
            )
            sink.report(rules.STALE_CARRIER, message, gearbox.location, found=gearbox.name)
            del joints[gearbox.name]
    return model.copy(joints=tuple(joints.values()))


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
