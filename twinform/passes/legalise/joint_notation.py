"""How joints are written: between links and with axes in their own frames in URDF, and in SDF again as it had them."""

import math
from typing import ClassVar

from twinform.diagnostics import DiagnosticSink, rules
from twinform.diagnostics.rules import STALE_CARRIER
from twinform.ir import Axis, Format, Joint, Limit, Model, replace_fields
from twinform.ir.defaults import AXIS, UNLIMITED, direction, filled, multiplier
from twinform.ir.frames import MODEL, WORLD, FrameGraph
from twinform.passes.carriers.annotations import (
    CONTINUOUS,
    MIMIC,
    OLD_NAME,
    REVERSED,
    SYNTHESIZED,
    came_from,
    find_annotation,
    without_annotation,
)
from twinform.passes.framework.pass_base import ModelPass
from twinform.passes.legalise.to_urdf_pass import ToUrdfPass, UrdfKeeper
from twinform.passes.shared.joint_ends import ENDS, describe_ends, report_self_joint, resolve_ends
from twinform.passes.structure.reversal import REVERSIBLE, reroot_sdf


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
    message = describe_ends(joint, pieces)
    keeper.account(rules.JOINT_END, message, joint.location, sum(piece.weight for piece in pieces))
    ends = {piece.element.name: piece.element.text for piece in pieces if piece.element}
    return keeper.annotate(resolved, ENDS, attributes=ends)


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
        return replace_fields(model, joints=tuple(joints))


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


_AXIS_FIELDS = ("axis", "axis2")
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
    if joint.type != "prismatic":  # which are the slides that a planar joint has just become
        joint = without_annotation(joint, SYNTHESIZED)
    joint = _restore_mimic(joint, sink)
    axes = {
        name: axis for name in _AXIS_FIELDS if (axis := getattr(joint, name)) is not None and axis.limit is not None
    }
    if axes:
        joint = joint.copy(**{name: _without_infinities(axis) for name, axis in axes.items()})
    return _restore_continuous(joint, sink)


def _without_infinities(axis: Axis) -> Axis:
    limit = axis.limit or Limit.unchecked()
    update = {name: None for name in _NUMBERS if _sign(name) * (getattr(limit, name) or 0.0) >= UNLIMITED}
    bare = limit.copy(**update) if update else limit
    return axis.copy(limit=None if bare == Limit.unchecked() else bare)


def _sign(name: str) -> int:
    """The sign of a number that limits nothing: a lower limit is then far below zero."""
    return -1 if name == "lower" else 1


def _restore_continuous(joint: Joint, sink: DiagnosticSink) -> Joint:
    if find_annotation(joint, CONTINUOUS) is None:
        return joint
    joint = without_annotation(joint, CONTINUOUS)
    limit = joint.axis.limit if joint.axis and joint.axis.limit else Limit.unchecked()
    # A joint without a range is revolute in URDF's conversion, since no engine of Gazebo has
    # `continuous`: DART makes such a joint a fixed one.
    if joint.type == "revolute" and limit.lower is None and limit.upper is None:
        return joint.copy(type="continuous")
    message = f"joint {joint.name!r} was continuous, and has another type or limits now"
    sink.report(STALE_CARRIER, message, joint.location, found=joint.type)
    return joint


def _restore_mimic(joint: Joint, sink: DiagnosticSink) -> Joint:
    made = restore_reference(joint)
    if made is not None:
        return made
    found = find_annotation(joint, MIMIC)
    message = f"joint {joint.name!r} does not mimic any more, or its reference is no number"
    sink.report(STALE_CARRIER, message, joint.location, found=(found and found.get("reference")) or "")
    return without_annotation(joint, MIMIC)


def without_reversals(model: Model) -> Model:
    """The model with joints reversed back that the conversion to URDF reversed."""
    turned = [joint for joint in model.joints if find_annotation(joint, REVERSED) and joint.type in REVERSIBLE]
    if not turned:
        return model
    names = {joint.name for joint in turned}
    made = reroot_sdf(model, turned).joints  # a frame stays on its joint, whatever that moves
    joints = (without_annotation(joint, REVERSED) if joint.name in names else joint for joint in made)
    return model.copy(joints=tuple(joints))


def restore_reference(joint: Joint) -> Joint | None:
    """The joint with the annotated `reference` of its mimic; None without a mimic or with an invalid number.

    multiplier (leader - reference) + offset is what URDF writes as multiplier leader + offset.
    """
    found = find_annotation(joint, MIMIC)
    if found is None:
        return joint
    axis: Axis | None = joint.axis
    reference = _number(found.get("reference"))
    if axis is None or axis.mimic is None or reference is None:
        return None
    factor = multiplier(axis.mimic)
    offset = (axis.mimic.offset or 0.0) + factor * reference if reference else axis.mimic.offset
    mimic = axis.mimic.copy(reference=reference, offset=offset or None)
    made: Axis = axis.copy(mimic=mimic)
    return without_annotation(joint, MIMIC).copy(axis=made)


def _number(text: str | None) -> float | None:
    try:
        number = float(text or "")
    except ValueError:
        return None
    return number if math.isfinite(number) else None
