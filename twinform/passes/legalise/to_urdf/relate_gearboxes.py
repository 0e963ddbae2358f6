"""Converting gearbox joints to `<mimic>`."""

from typing import ClassVar

from twinform.diagnostics import Fate, Severity, rules
from twinform.ir import Axis, Joint, Mimic, Model, count_parts
from twinform.ir.frames import FrameGraph
from twinform.passes.carriers.annotations import with_annotation
from twinform.passes.legalise.to_urdf.build_tree import cut_joints
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper
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
