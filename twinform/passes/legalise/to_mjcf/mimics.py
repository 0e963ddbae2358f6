"""Joints that follow others: mimic and gearbox joints of SDF as `equality/joint` of MJCF.

The follower is at multiplier * (leader - reference) + offset, a polynomial of the leader. MuJoCo holds it by a
constraint, which gives way a little under a force.
"""

from twinform.diagnostics import rules
from twinform.ir import Element, Joint
from twinform.ir.defaults import multiplier
from twinform.ir.frames import FrameGraph
from twinform.ir.joint import Mimic
from twinform.passes.legalise.to_mjcf.elements import make_element
from twinform.passes.legalise.to_mjcf.kept_mjcf import with_kept_equality
from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext
from twinform.passes.shared.joint_ends import UngearedError, relation

_SCALAR = frozenset({"revolute", "continuous", "prismatic", "universal", "revolute2", "screw"})
"""The types of joints that have a position which is one number for each axis."""


def add_mimics(context: MjcfContext) -> None:
    """Add an equality for each joint that mimics another. All joints have their names by now."""
    for name, joint in context.tree.joints.items():
        for number, axis in enumerate((joint.axis, joint.axis2)):
            if axis is not None and axis.mimic is not None and context.written_joints.get(name):
                _add_mimic(context, name, joint, number, axis.mimic)


def _add_mimic(context: MjcfContext, name: str, joint: Joint, number: int, mimic: Mimic) -> None:
    ends = coupled_joints(context, name, number, context.scope_of(name) + (mimic.joint or ""), mimic.axis)
    if ends is None:
        message = f"joint {joint.name!r} cannot follow {mimic.joint!r} in MJCF"
        context.approximate(rules.UNKNOWN_LEADER, message, mimic.location, 0)  # its text holds all of it
        return
    follower, leader = ends
    factor = multiplier(mimic)
    offset = (mimic.offset or 0.0) - factor * (mimic.reference or 0.0)
    context.add("equality", with_kept_equality(_relation(follower, leader, offset, factor), joint))


def coupled_joints(
    context: MjcfContext, name: str, number: int, leader: str, axis: str | None
) -> tuple[str, str] | None:
    """The joint of MJCF for an axis of a joint that mimics another, and that for the axis which it follows.

    None where either has no position that an equality could hold, as a joint that closes a loop. Names are scoped.
    """
    follower = _written(context, name, number)
    led_by = _written(context, leader, 1 if axis == "axis2" else 0)
    return None if follower is None or led_by is None or follower == led_by else (follower, led_by)


def _relation(follower: str, leader: str, offset: float, factor: float) -> Element:
    """The equality that keeps a joint of MJCF at `factor` times the position of another, plus `offset`."""
    polynomial = (offset + 0.0, factor, 0.0, 0.0, 0.0)
    return make_element("joint", [("joint1", follower), ("joint2", leader), ("polycoef", polynomial)])


def _written(context: MjcfContext, name: str, number: int) -> str | None:
    """The joint of MJCF for one axis of a joint; None where there is none that has a position."""
    joint = context.tree.joints.get(name)
    names = context.written_joints.get(name, ())
    return names[number] if joint is not None and joint.type in _SCALAR and number < len(names) else None


def add_gearboxes(context: MjcfContext) -> None:
    """Add an equality for each gearbox, between the two joints that it couples."""
    for scope, model in context.models:
        gearboxes = [joint for joint in model.joints if joint.type == "gearbox"]
        if not gearboxes:
            continue
        joints = {joint.name: joint for joint in model.joints if joint.type != "gearbox"}
        graph = FrameGraph(model)
        for gearbox in gearboxes:
            _add_gearbox(context, scope, gearbox, joints, graph)


def _add_gearbox(context: MjcfContext, scope: str, gearbox: Joint, joints: dict[str, Joint], graph: FrameGraph) -> None:
    try:
        found = relation(gearbox, joints, graph)
    except UngearedError as error:
        message = f"gearbox {gearbox.name!r} couples nothing in MJCF: {error}"
        context.sink.report(rules.GEARBOX, message, gearbox.location, found=gearbox.name)
        return
    follower, leader = (_written(context, scope + name, 0) for name in (found.follower, found.leader))
    if follower is None or leader is None:
        return
    message = f"gearbox {gearbox.name!r} is a constraint: joint {found.follower!r} follows {found.leader!r}"
    context.approximate(rules.GEARBOX, message, gearbox.location)
    context.add("equality", _relation(follower, leader, 0.0, found.multiplier))
