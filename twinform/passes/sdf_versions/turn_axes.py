"""Joint axes in the joint frame or the model frame, as before SDF 1.7."""

from functools import partial
from typing import ClassVar

from twinform.diagnostics import rules
from twinform.ir import Axis, Document, Element, Format, Joint, Model, Opaque, rewrite
from twinform.ir.defaults import AXIS, direction
from twinform.ir.frames import MODEL, FrameGraph
from twinform.passes.carriers.sdf_versions import VersionCondition, VersionKeeper
from twinform.passes.sdf_versions.version_pass import VersionPass
from twinform.schemas import Version, format_value

_NAMES: Version = (1, 7)
_SINCE: Version = (1, 5)


class TurnAxes(VersionPass):
    """Express axes in the frames that an older version has for them.

    Changes: 1. an axis in `__model__` has `use_parent_model_frame` from 1.5 on, and needs nothing before; 2. any other
    that names a frame is turned into the joint's, or before 1.5 into the model's, as are those that name none.
    Never touches: the numbers of an axis that has the right frame already.
    Diagnostics: in the ledger `other-words`.
    """

    name: ClassVar[str] = "turn-axes"

    def change(self, document: Document, keeper: VersionKeeper) -> Document:
        """The document with axes in the syntax of the version."""
        return rewrite(document, Model, partial(_turn_in_model, keeper, self.number >= _SINCE))


def _turn_in_model(keeper: VersionKeeper, has_attribute: bool, model: Model) -> Model:
    axes = [axis for joint in model.joints for axis in (joint.axis, joint.axis2) if axis]
    if all(axis.expressed_in is None and has_attribute for axis in axes):
        return model
    turn = _Turner(keeper, FrameGraph(model), has_attribute=has_attribute)
    return model.copy(joints=tuple(map(turn.joint, model.joints)))


class _Turner:
    """Turns the axes of one model."""

    def __init__(self, keeper: VersionKeeper, graph: FrameGraph, *, has_attribute: bool) -> None:
        self.keeper = keeper
        self.graph = graph
        self.has_attribute = has_attribute

    def joint(self, joint: Joint) -> Joint:
        for field in ("axis", "axis2"):
            axis: Axis | None = getattr(joint, field)
            if axis is not None:
                joint = self._turn_axis(joint, field, axis)
        return joint

    def _turn_axis(self, joint: Joint, field: str, axis: Axis) -> Joint:
        frame = axis.expressed_in
        if self.has_attribute and frame == MODEL:
            values = axis.copy(expressed_in=None, use_parent_model_frame=True)
            return joint.copy(**{field: values})
        if not self.has_attribute:
            plain = axis.copy(expressed_in=None, use_parent_model_frame=None)
            in_model = frame == MODEL or axis.use_parent_model_frame
            return joint.copy(**{field: plain}) if in_model else self._express(joint, field, axis, MODEL)
        return joint if frame is None else self._express(joint, field, axis, joint.name)

    def _express(self, joint: Joint, field: str, axis: Axis, base: str) -> Joint:
        """The joint with the axis in another frame, and the axis that it had in a carrier."""
        to_model = base == MODEL
        turn = self.graph.pose(
            axis.expressed_in or joint.name, base, kind="joint", base="model" if to_model else "joint"
        )
        x, y, z = turn.rotate(direction(axis, Format.SDF))
        # Adding 0.0 turns -0.0 into 0.0.
        xyz = None if axis.xyz is None and (x, y, z) == AXIS[Format.SDF] else (x + 0.0, y + 0.0, z + 0.0)
        plain = axis.copy(xyz=xyz, expressed_in=None)
        turned = joint.copy(**{field: plain})
        message = f"the axis of joint {joint.name!r} is expressed in {axis.expressed_in or 'its own frame'}"
        written = axis.xyz is not None or axis.expressed_in is not None
        # back in newer syntax, an axis that was written without a frame is one in the model
        gone = [f"{field}.expressed_in"] if to_model and axis.expressed_in is None else []
        gone += [f"{field}.xyz"] if axis.xyz is None and xyz is not None else []
        condition = VersionCondition(since=_NAMES, without=tuple(gone))
        pieces = [_axis_piece(field, axis)] if written else []
        weight = (axis.xyz is not None) + (axis.expressed_in is not None)
        return self.keeper.keep(turned, pieces, condition, rules.OTHER_WORDS, message, axis.location, weight)


def _axis_piece(field: str, axis: Axis) -> Opaque:
    attributes = () if axis.expressed_in is None else (("expressed_in", axis.expressed_in),)
    text = format_value(axis.xyz) if axis.xyz is not None else None
    return Opaque.unchecked(at=field, element=Element.unchecked(name="xyz", attributes=attributes, text=text))
