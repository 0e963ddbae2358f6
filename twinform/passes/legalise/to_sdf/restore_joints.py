"""Reverse conversion of joints: restoring how the SDF source wrote them."""

from typing import ClassVar

from twinform.diagnostics import DiagnosticSink
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Axis, Format, Joint, Limit, Model
from twinform.ir.defaults import UNLIMITED
from twinform.passes.carriers.annotations import SYNTHESIZED, find_annotation, without_annotation
from twinform.passes.carriers.joint_words import CONTINUOUS, MIMIC
from twinform.passes.carriers.provenance import came_from
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.to_sdf.mimic_references import with_reference
from twinform.passes.legalise.to_sdf.reversals import without_reversals

_AXES = ("axis", "axis2")
_NUMBERS = ("lower", "upper", "effort", "velocity")


class RestoreJoints(ModelPass):
    """Write joints as SDF wrote them, in a model that came from there.

    Changes: 1. a joint that an annotation calls reversed is reversed again, wherever its model came from; 2. limits of
    1e16 and beyond, which stand for none, go; 3. a joint without limits that an annotation calls `continuous` is so; 4.
    the offset of a mimic is shared with the `reference` in an annotation.
    Never touches: else, models that did not come from SDF.
    Diagnostics: `stale-carrier`.
    """

    name: ClassVar[str] = "restore-joints"

    def run_model(self, model: Model, sink: DiagnosticSink) -> Model:
        """The model with joints of its SDF file."""
        model = without_reversals(model)
        if not came_from(model, Format.SDF):
            return model
        return model.copy(joints=tuple(_restore_joint(joint, sink) for joint in model.joints))


def _restore_joint(joint: Joint, sink: DiagnosticSink) -> Joint:
    joint = _with_reference(without_annotation(joint, SYNTHESIZED), sink)
    axes = {name: axis for name in _AXES if (axis := getattr(joint, name)) is not None and axis.limit is not None}
    if axes:
        joint = joint.copy(**{name: _without_infinities(axis) for name, axis in axes.items()})
    return _continuous(joint, sink)


def _without_infinities(axis: Axis) -> Axis:
    limit = axis.limit or Limit()
    update = {name: None for name in _NUMBERS if _sign(name) * (getattr(limit, name) or 0.0) >= UNLIMITED}
    bare = limit.copy(**update) if update else limit
    return axis.copy(limit=None if bare == Limit() else bare)


def _sign(name: str) -> int:
    """On which side a number that limits nothing is: of a lower limit far below."""
    return -1 if name == "lower" else 1


def _continuous(joint: Joint, sink: DiagnosticSink) -> Joint:
    if find_annotation(joint, CONTINUOUS) is None:
        return joint
    joint = without_annotation(joint, CONTINUOUS)
    limit = joint.axis.limit if joint.axis and joint.axis.limit else Limit()
    # A joint without a range is revolute in URDF's conversion, since no engine of Gazebo has
    # `continuous`: DART makes such a joint a fixed one.
    if joint.type == "revolute" and limit.lower is None and limit.upper is None:
        return joint.copy(type="continuous")
    message = f"joint {joint.name!r} was continuous, and has another type or limits now"
    sink.report(STALE_CARRIER, message, joint.location, found=joint.type)
    return joint


def _with_reference(joint: Joint, sink: DiagnosticSink) -> Joint:
    made = with_reference(joint)
    if made is not None:
        return made
    found = find_annotation(joint, MIMIC)
    message = f"joint {joint.name!r} does not mimic any more, or its reference is no number"
    sink.report(STALE_CARRIER, message, joint.location, found=(found and found.get("reference")) or "")
    return without_annotation(joint, MIMIC)
