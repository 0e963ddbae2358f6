"""Expressing joint axes in the joint frame, as URDF requires."""

from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Axis, Format, Joint, Model
from twinform.ir.defaults import AXIS, direction, filled
from twinform.ir.frames import MODEL, FrameGraph
from twinform.passes.carriers.annotations import OLD_NAME
from twinform.passes.legalise.to_urdf.to_urdf_pass import ToUrdfPass, UrdfKeeper

_AXES = {
    **dict.fromkeys(("revolute", "continuous", "prismatic", "screw"), ("axis",)),
    **dict.fromkeys(("universal", "revolute2", "gearbox"), ("axis", "axis2")),
}
"""The axes that mean something, by the type of the joint."""


class ExpressAxes(ToUrdfPass):
    """Write every axis, in the joint frame.

    Changes: 1. an axis that is expressed in another frame is turned into the joint's; its numbers stay where that is no
    turn; 2. an axis that is not written is SDF's, z. Joints with two axes have both of them written so.
    Diagnostics: `zero-axis`; in the ledger `axis-frame`.
    """

    name: ClassVar[str] = "express-axes"

    def run_model(self, model: Model, keeper: UrdfKeeper) -> Model:
        """The model with its axes in the joint frames."""
        if not any(joint.type in _AXES for joint in model.joints):
            return model
        graph = FrameGraph(model)
        joints: list[Joint] = []
        for joint in model.joints:
            expressed = joint
            for field in _AXES.get(joint.type, ()):
                expressed = _express_axis(expressed, field, graph, keeper)
            joints.append(expressed)
        return model.copy(joints=tuple(joints))


def _express_axis(joint: Joint, field: str, graph: FrameGraph, keeper: UrdfKeeper) -> Joint:
    written: Axis | None = getattr(joint, field)
    axis = written or Axis.unchecked()
    if axis.xyz is not None and not any(axis.xyz):
        message = f"the {field} of joint {joint.name!r} has length zero"
        keeper.sink.report(rules.ZERO_AXIS, message, axis.location, found="0 0 0")
    if not axis.expressed_in:
        made = filled(axis, {"xyz": AXIS[Format.SDF]})
        return joint if made is axis else joint.copy(**{field: made})
    turn = graph.pose(axis.expressed_in, joint.name, kind="frame", base="joint")
    x, y, z = turn.rotate(direction(axis, Format.SDF))
    # Adding zero turns -0.0 into 0.0, which would be written otherwise.
    xyz = (x + 0.0, y + 0.0, z + 0.0)
    made = axis.copy(**{"xyz": xyz, "expressed_in": None, OLD_NAME: None})
    turned = joint.copy(**{field: made})
    message = f"the {field} of joint {joint.name!r} is expressed in {axis.expressed_in!r}"
    keeper.account(rules.AXIS_FRAME, message, axis.location, 2)
    word: dict[str, str | None] = {"expressed_in": axis.expressed_in}
    if axis.use_parent_model_frame:
        word = {OLD_NAME: "true", "expressed_in": None if axis.expressed_in == MODEL else axis.expressed_in}
    return keeper.annotate(turned, field, attributes=word)
