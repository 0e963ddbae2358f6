"""Joints of MJCF: hinges, slides and balls of a body, with ranges, efforts, damping and springs.

A body of MJCF may have several joints, which act in their order, the first next to the parent. So the two axes of a
universal joint are two hinges of one body, and so are the joints of a chain that stands for a planar one.
"""

import math
from collections.abc import Iterator, Sequence

from twinform.diagnostics import rules
from twinform.ir import Axis, Element, Joint
from twinform.ir.defaults import UNLIMITED, direction
from twinform.ir.document import Format
from twinform.ir.joint import Dynamics, JointType, Limit
from twinform.ir.kinematic_tree import JointBetween
from twinform.ir.node import Vector3
from twinform.ir.transform import Transform, rounded
from twinform.passes.carriers.joint_chains import CHAINS, TWO_AXES, metres_per_radian
from twinform.passes.legalise.to_mjcf.elements import Value, make_element, position
from twinform.passes.legalise.to_mjcf.kept_mjcf import FORCE, kept_joints, with_kept_joint
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext

_KINDS: dict[JointType, str] = {
    "revolute": "hinge",
    "continuous": "hinge",
    "prismatic": "slide",
    "ball": "ball",
    "spherical": "ball",
    "universal": "hinge",
    "revolute2": "hinge",
    "screw": "hinge",
}
_NARROW = 1e-9
"""Half the range of a joint whose ends are one, in rad or m: MuJoCo wants the lower one below the upper one."""


def joint_elements(context: MjcfContext, body: Body, held_by: Sequence[JointBetween]) -> list[Element]:
    """The joints between a body and its parent, the nearest to the parent first; none for a fixed joint.

    Raises:
        FrameError: a frame is not known, or frames go round in a circle.
    """
    if body.name in context.static_links:
        return []
    return [element for each in held_by for element in _elements(context, body, each)]


def _elements(context: MjcfContext, body: Body, between: JointBetween) -> Iterator[Element]:
    """Yield the joints that stand for one of SDF."""
    joint = between.joint
    if joint.type == "fixed":
        context.written_joints[between.name] = ()
        return
    if joint.type not in _KINDS:
        message = f"joint {joint.name!r} is {joint.type}, a type that MJCF does not have"
        context.sink.report(rules.JOINT_TYPE_UNSUPPORTED, message, joint.location.at("@type"), found=joint.type)
        return
    at = context.place(between.name, body.name, kind="joint")
    if joint.type == "screw":
        yield from _screw(context, body, between, at)
        return
    if joint.type in TWO_AXES:
        yield from _two_axes(context, body, between, at)
        return
    name = _name(context, between, _wish(context, between))
    context.written_joints[between.name] = (name,)
    context.note_made_name("joint", joint, name, f"{body.link.name}_joint")  # one that was fixed is called otherwise
    yield _element(context, body, between, at, joint.axis, name, *kept_joints(joint))


def _two_axes(context: MjcfContext, body: Body, between: JointBetween, at: Transform) -> Iterator[Element]:
    """Yield two hinges: the first axis turns with the parent, and the second with the child."""
    joint = between.joint
    kept = kept_joints(joint, 2)
    names = context.written_joints[between.name] = _names(context, between, kept)
    for axis, name, each in zip((joint.axis, joint.axis2), names, kept, strict=True):
        yield _element(context, body, between, at, axis, name, each)


def _screw(context: MjcfContext, body: Body, between: JointBetween, at: Transform) -> Iterator[Element]:
    """Yield a slide and a hinge along one axis, and couple them."""
    joint = between.joint
    pitch = metres_per_radian(joint)
    if pitch is None:
        message = f"screw joint {joint.name!r} has a thread of 0 rad/m, and slides without turning"
        help_ = "write a prismatic joint, or a pitch"
        context.sink.report(rules.JOINT_TYPE_UNSUPPORTED, message, joint.location, found="screw", help=help_)
        return
    kept = kept_joints(joint, 2)
    slide, turn = _names(context, between, kept)
    context.written_joints[between.name], context.written_slides[between.name] = (turn,), slide
    along = Axis.unchecked(xyz=joint.axis.xyz, expressed_in=joint.axis.expressed_in) if joint.axis else None
    yield _element(context, body, between, at, along, slide, kept[0], kind="slide")
    yield _element(context, body, between, at, joint.axis, turn, kept[1])
    message = f"screw joint {joint.name!r} is a slide and a hinge, which a constraint couples"
    context.approximate(rules.JOINT_CHAIN, message, joint.location)
    polynomial = (0.0, pitch, 0.0, 0.0, 0.0)
    context.add("equality", make_element("joint", [("joint1", slide), ("joint2", turn), ("polycoef", polynomial)]))


def _wish(context: MjcfContext, between: JointBetween) -> str:
    scope = context.scope_of(between.name)
    return context.wish("joint", scope, context.old_name("joint", scope, between.joint))


def _names(context: MjcfContext, between: JointBetween, kept: Sequence[Element | None]) -> tuple[str, str]:
    """The names of the two joints that stand for one: those that they were given in MJCF, or made ones."""
    wish = _wish(context, between)
    wishes = (f"{wish}_{CHAINS[between.joint.type][0]}", wish)
    first, last = ((each and each.get("name")) or usual for each, usual in zip(kept, wishes, strict=True))
    return _name(context, between, first), _name(context, between, last)


def _name(context: MjcfContext, between: JointBetween, wanted: str) -> str:
    return context.name("joint", wanted, between.joint) or wanted


def _element(
    context: MjcfContext,
    body: Body,
    between: JointBetween,
    at: Transform,
    axis: Axis | None,
    name: str,
    kept: Element | None,
    *,
    kind: str | None = None,
) -> Element:
    """One joint of MJCF, about or along one axis, with what is `kept` of the one that it was read from."""
    joint = between.joint
    kind = kind or _KINDS[joint.type]
    attributes: list[tuple[str, Value]] = [("name", name), ("type", kind)]
    # Where a slide is does not matter, but for what MJCF has said.
    if any(at.translation) and (kind != "slide" or context.is_of_mjcf):
        attributes.append(("pos", position(at)))
    if kind != "ball":
        attributes.append(("axis", _direction(context, body, between, at, axis)))
    limit = axis.limit if axis else None
    if limit is not None and joint.type not in {"ball", "spherical"}:
        ends = _range(context, joint, limit) if joint.type != "continuous" else []
        attributes += [*ends, *_effort(context, joint, limit)]
    if axis is not None and axis.dynamics is not None:
        attributes += _dynamics(axis.dynamics)
    if kind != "ball" and joint.type not in TWO_AXES and (rotor := context.rotors.get(between.name)):
        attributes.append(("armature", rotor.armature))
    element = with_kept_joint(make_element("joint", attributes, (), joint.source), kept)
    if kind != "ball" and element.get(FORCE[1]) is None:
        context.efforts[name] = _greatest_effort(limit)
    return element


def _direction(context: MjcfContext, body: Body, between: JointBetween, at: Transform, axis: Axis | None) -> Vector3:
    """Where an axis points, in the frame of the body."""
    written = direction(axis, Format.SDF)
    if axis is None or not axis.expressed_in:
        return rounded(at.rotate(written))
    frame = axis.expressed_in
    scoped = frame if frame == "world" else context.scope_of(between.name) + frame
    return rounded(context.place(scoped, body.name, kind="joint").rotate(written))


def _range(context: MjcfContext, joint: Joint, limit: Limit) -> list[tuple[str, Value]]:
    """`limited` and `range`; none where both ends are infinite."""
    lower = -math.inf if limit.lower is None or limit.lower <= -UNLIMITED else limit.lower
    upper = math.inf if limit.upper is None or limit.upper >= UNLIMITED else limit.upper
    if lower == -math.inf and upper == math.inf:
        return []
    if lower > upper:
        message = f"joint {joint.name!r} has a lower limit above the upper one, and no limits in MJCF"
        context.approximate(rules.LOWER_ABOVE_UPPER, message, limit.location, 2)
        return []
    if lower == upper:
        message = f"joint {joint.name!r} can only be at {lower:g}, and gets a range of {2 * _NARROW:g} in MJCF"
        context.approximate(rules.EMPTY_RANGE, message, limit.location, 0)
        lower, upper = lower - _NARROW, upper + _NARROW
    return [("limited", True), ("range", (lower, upper))]


def _effort(context: MjcfContext, joint: Joint, limit: Limit) -> list[tuple[str, Value]]:
    """`actuatorfrcrange`: the forces of all motors of a joint together; none where they are not limited."""
    effort = limit.effort
    # A negative one is SDF's word for no limit before 1.10.
    if effort is None or effort < 0 or effort >= UNLIMITED:
        return []
    if effort == 0:
        # MuJoCo wants the lower end of a range below the upper one.
        message = f"joint {joint.name!r} has an effort of 0, and MJCF can limit no force to nothing"
        context.approximate(rules.ZERO_LIMIT, message, limit.location, 0)
        return []
    return [("actuatorfrclimited", True), ("actuatorfrcrange", (-effort, effort))]


def _greatest_effort(limit: Limit | None) -> float:
    """The effort of a joint; infinite where nothing limits it."""
    effort = limit.effort if limit is not None else None
    return math.inf if effort is None or effort < 0 or effort >= UNLIMITED else effort


def _dynamics(dynamics: Dynamics) -> Iterator[tuple[str, Value]]:
    """Yield damping, friction and the spring; zero is the default of MJCF too."""
    for name, value in (
        ("damping", dynamics.damping),
        ("frictionloss", dynamics.friction),
        ("stiffness", dynamics.spring_stiffness),
        ("springref", dynamics.spring_reference),
    ):
        if value:
            yield name, value
