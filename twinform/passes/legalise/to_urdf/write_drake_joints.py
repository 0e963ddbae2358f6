"""Reverse conversion of Drake's own joints."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.ir import Model, Opaque
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.shared.drake_joints import DRAKE, DRAKE_TYPES, drake_element


class WriteDrakeJoints(ModelPass):
    """Write joints that were `<drake:joint>` as such.

    Changes: an annotated joint of a type that Drake has is an element of the robot.
    Never touches: one with another type by now.
    Diagnostics: none.
    """

    name: ClassVar[str] = "write-drake-joints"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with the elements of Drake."""
        own = [joint for joint in model.joints if find_annotation(joint, DRAKE) and joint.type in DRAKE_TYPES]
        if not own or sink.has_errors:
            return model
        elements = (Opaque.unchecked(element=drake_element(joint), source=joint.source) for joint in own)
        names = {joint.name for joint in own}
        joints = tuple(joint for joint in model.joints if joint.name not in names)
        return model.copy(joints=joints, opaque=(*model.opaque, *elements))
