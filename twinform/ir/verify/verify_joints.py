"""Verifies joints: parent and child, axes, limits and mimic, and the kinematic tree that they make."""

import math
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from functools import partial

from twinform.diagnostics import DiagnosticSink, Location, Severity, did_you_mean, rules
from twinform.diagnostics.rules import RANGE_IN_DEGREES
from twinform.ir.groups import Groups
from twinform.ir.joint import Axis, Joint, Limit, Mimic
from twinform.ir.node import Vector3
from twinform.ir.versions import Version

_FREEDOMS = {
    **dict.fromkeys(("revolute", "continuous", "prismatic", "screw", "planar"), 1),
    **dict.fromkeys(("gearbox", "universal", "revolute2"), 2),
}
"""How many axes a type of joint moves about or along; the others have none."""
_LIMITED = frozenset({"revolute", "prismatic"})
# Limits of more than two turns are usual for winches and wheels. Of those that are whole multiples
# of five up to 360, the corpus has ten joints of five grippers with -20 to 20, which are meant.
_MOST_TURNS = 4 * math.pi
_MOST_MEANT = 20
_WHOLE_TURN = 360
# Limits in degrees are mostly multiples of this; those of a winch in radians hardly ever.
_STEP = 5
_NEEDED = ("effort", "velocity")
_POSITIONS = ("lower", "upper")
_POSITIONS_SINCE = (1, 2)
# How far the length of an axis may be from 1: files write three digits.
_ROUNDING = 1e-3


def verify_joint(joint: Joint, sink: DiagnosticSink, *, every_axis: bool = False) -> None:
    """Report what is wrong with a joint by itself; `every_axis` is whether readers look at unused axes, too."""
    report_self_joint(joint, sink)
    freedoms = _FREEDOMS.get(joint.type, 0)
    axis, axis2 = joint.axis, joint.axis2
    for number, (name, each) in enumerate((("axis", axis), ("axis2", axis2))):
        if each is not None and freedoms > number:
            _verify_axis(joint, name, each, sink, is_urdf=not every_axis)
        elif each is not None and not _is_of_mjcf(each):
            # what MJCF says of a ball needs an axis only here
            _verify_unused(joint, name, each, sink, is_read=every_axis)
    if freedoms and (axis is None or axis.xyz is None):
        _missing(joint, "axis", sink)
    if freedoms > 1 and (axis2 is None or axis2.xyz is None):
        _missing(joint, "axis2", sink)


def report_self_joint(joint: Joint, sink: DiagnosticSink) -> None:
    """Report a joint between a link and that link itself."""
    if joint.parent is not None and joint.parent == joint.child:
        message = f"joint {joint.name!r} connects {joint.parent!r} to itself"
        sink.report(rules.SELF_JOINT, message, joint.location, found=joint.parent)


def _missing(joint: Joint, name: str, sink: DiagnosticSink) -> None:
    message = f"{joint.type} joint {joint.name!r} has no <{name}>; the default is x in URDF and z in SDF"
    sink.report(rules.MISSING_AXIS, message, joint.location, expected=f"<{name}>")


def _verify_unused(joint: Joint, name: str, axis: Axis, sink: DiagnosticSink, *, is_read: bool) -> None:
    message = f"{joint.type} joint {joint.name!r} has an <{name}>, which nothing turns about or slides along"
    sink.report(rules.UNUSED_AXIS, message, _place(joint, name, axis), found=f"<{name}>")
    if is_read and axis.xyz is not None and not any(axis.xyz):
        _verify_length(joint, axis.xyz, _place(joint, name, axis), sink)


def _verify_axis(joint: Joint, name: str, axis: Axis, sink: DiagnosticSink, *, is_urdf: bool) -> None:
    if axis.xyz is not None:
        x, y, z = axis.xyz
        if x * x + y * y + z * z != 1.0 and not _is_of_mjcf(axis):
            # any length is usual in MJCF, and its front end has refused those without one
            _verify_length(joint, axis.xyz, _place(joint, name, axis), sink)
    if axis.limit is not None:
        _verify_limit(joint, axis.limit, sink, is_urdf=is_urdf)


def _place(joint: Joint, name: str, axis: Axis) -> Location:
    """Where the axis is written. Where URDF's <limit> stands first, the axis was synthesized there."""
    return axis.location if axis.source and axis.source.step == name else joint.location.at(name)


def _is_of_mjcf(axis: Axis) -> bool:
    """Whether it was read of MJCF, where an axis is an attribute of its joint."""
    return axis.source is not None and axis.source.step == "joint"


def _verify_length(joint: Joint, xyz: Vector3, where: Location, sink: DiagnosticSink) -> None:
    if not any(xyz):
        message = f"the axis of joint {joint.name!r} has length zero"
        sink.report(rules.ZERO_AXIS, message, where, found="0 0 0")
        return
    length = math.hypot(*xyz)
    if abs(length - 1) > _ROUNDING:
        message = f"the axis of joint {joint.name!r} has length {length:.4g}; readers normalize it"
        sink.report(rules.UNNORMALISED_AXIS, message, where, found=f"{length:.4g}", expected="1")


def _verify_limit(joint: Joint, limit: Limit, sink: DiagnosticSink, *, is_urdf: bool) -> None:
    if joint.type == "continuous":
        if limit.lower or limit.upper:
            message = f"continuous joint {joint.name!r} has limits, which every reader ignores"
            sink.report(rules.UNUSED_LIMIT, message, limit.location)
    elif limit.lower is not None and limit.upper is not None and limit.lower > limit.upper:
        message = f"joint {joint.name!r} has the lower limit {limit.lower:g} above the upper limit {limit.upper:g}"
        sink.report(rules.LOWER_ABOVE_UPPER, message, limit.location, found=f"{limit.lower:g}")
    if joint.type == "revolute" and _is_in_degrees(limit.lower or 0.0, limit.upper or 0.0):
        message = (
            f"joint {joint.name!r} turns from {limit.lower or 0:g} to {limit.upper or 0:g} rad; are these degrees?"
        )
        hint = f"write radians: {math.radians(limit.lower or 0):.6g} to {math.radians(limit.upper or 0):.6g}"
        sink.report(RANGE_IN_DEGREES, message, limit.location, found=f"{limit.upper or limit.lower:g}", help=hint)
    if limit.effort == 0 or limit.velocity == 0:
        which = " and ".join(word for word in ("effort", "velocity") if getattr(limit, word) == 0)
        message = f"joint {joint.name!r} has the limit 0 for {which}; a controller that obeys it cannot move it"
        # Effort and velocity of 0 are an idiom for "unknown", and to Drake for a joint without a motor. In URDF, where
        # limits that are not written are 0, it is locked besides; those that are written and equal are `empty-range`.
        is_locked = joint.type in _LIMITED and not any((limit.lower, limit.upper, limit.effort, limit.velocity))
        is_locked = is_locked and is_urdf and (limit.lower is None or limit.upper is None)
        severity = Severity.WARNING if is_locked else None
        sink.report(rules.ZERO_LIMIT, message, limit.location, found="0", severity=severity)


def _is_in_degrees(lower: float, upper: float) -> bool:
    """Tell whether limits look like degrees: people write such numbers, and no robot has them in radians."""
    far = [abs(each) for each in (lower, upper) if abs(each) > _MOST_TURNS]
    return bool(far) and _MOST_MEANT < max(far) <= _WHOLE_TURN and not any(each % _STEP for each in far)


def verify_limits_there(joint: Joint, sink: DiagnosticSink, version: Version) -> None:
    """Report missing limits that a version of URDF requires where SDF has none by default."""
    limit = joint.axis.limit if joint.axis else None
    # urdfdom 6, joint.cpp, parseJointLimits: 1.2 lets go of effort and velocity, and no longer takes 0 for the others
    needed = _NEEDED if version < _POSITIONS_SINCE else _POSITIONS if joint.type in _LIMITED else ()
    missing = [name for name in needed if limit and getattr(limit, name) is None]
    if limit and missing:
        message = f"<limit> of joint {joint.name!r} has no {' and no '.join(map(repr, missing))}"
        sink.report(rules.PARTIAL_LIMIT, message, limit.location, expected=f"@{missing[0]}")
    if joint.type in _LIMITED and limit is None:
        message = f"{joint.type} joint {joint.name!r} has no <limit>"
        sink.report(rules.MISSING_LIMIT, message, joint.location, expected="<limit>")


def verify_mimics(joints: Iterable[Joint], sink: DiagnosticSink) -> None:
    """Report followers of nothing, and of each other."""
    followers = [(joint, axis) for joint in joints for axis in (joint.axis, joint.axis2) if axis and axis.mimic]
    if not followers:
        return
    known = {joint.name: joint for joint in joints}
    movable = [joint.name for joint in joints if joint.type in _FREEDOMS]
    leaders: dict[str, str] = {}
    for joint, axis in followers:
        mimic = axis.mimic
        what = useless_leader(joint, mimic, known) if mimic else ""
        if mimic is None or not what:
            leaders[joint.name] = (mimic and mimic.joint) or ""
            continue
        message = f"joint {joint.name!r} mimics {mimic.joint!r}, {what}"
        hint = None if mimic.joint in known else partial(did_you_mean, mimic.joint or "", movable, but=(joint.name,))
        sink.report(rules.UNKNOWN_LEADER, message, mimic.location, found=mimic.joint, help=hint)
    _report_circles(followers, leaders, sink)


def useless_leader(joint: Joint, mimic: Mimic, joints: Mapping[str, Joint]) -> str:
    """Return why nothing can follow the joint that is mimicked; empty if it is another joint with an axis."""
    leader = joints.get(mimic.joint or "")
    if leader is None:
        return "but there is no such joint"
    if leader.name == joint.name:
        return "itself"
    if leader.type in _FREEDOMS:
        return ""
    return "which is fixed and never moves" if leader.type == "fixed" else "which has no axis"


def _report_circles(followers: list[tuple[Joint, Axis]], leaders: dict[str, str], sink: DiagnosticSink) -> None:
    settled: set[str] = set()
    for joint, axis in followers:
        path: list[str] = []
        name = joint.name
        while name in leaders and name not in settled and name not in path:
            path.append(name)
            name = leaders[name]
        if name in path and axis.mimic:
            message = f"joints mimic each other: {', '.join(path[path.index(name) :])}"
            sink.report(rules.MIMIC_CYCLE, message, axis.mimic.location, found=name)
        settled.update(path)


def report_loops(joints: Iterable[Joint], sink: DiagnosticSink, severity: Severity | None = None) -> dict[str, Joint]:
    """Report links with two parents and circles; return the first joint of each child."""
    parents: dict[str, Joint] = {}
    groups = Groups()
    listed = list(joints)
    # A file of URDF with such a loop is refused by most readers, and is a robot of SDF all the same. What goes round in
    # a circle has no root, and no pass that goes up or down the tree comes to an end.
    is_tree = len({joint.child for joint in listed}) == len(listed)
    is_robot = severity is None and not is_tree and not _go_round(listed)
    for joint in listed:
        if joint.child is None:
            continue
        first = parents.setdefault(joint.child, joint)
        closes = joint.type != "gearbox" and not groups.join(joint.parent or "", joint.child)
        if first is not joint:
            message = f"link {joint.child!r} is the child of joint {first.name!r} and of joint {joint.name!r}"
            message += ", which closes a loop" if closes else ""
            related, refused = (first.location,), is_robot and closes
            level = Severity.WARNING if refused else severity
            sink.report(rules.TWO_PARENTS, message, joint.location, related=related, severity=level, refused=refused)
    for joint in _circles(parents):
        message = f"joint {joint.name!r} closes a loop of joints through link {joint.child!r}"
        sink.report(rules.KINEMATIC_LOOP, message, joint.location, severity=severity)
    return parents


def _go_round(joints: Sequence[Joint]) -> bool:
    """Whether some links are each below the next one, by any of their joints."""
    above = Counter(joint.child for joint in joints)
    below: defaultdict[str | None, list[str | None]] = defaultdict(list)
    for joint in joints:
        below[joint.parent].append(joint.child)
    waiting = [name for name in below if not above[name]]
    while waiting:  # the joints below a link that nothing holds any more hold nothing either
        for child in below.pop(waiting.pop(), ()):
            above[child] -= 1
            if not above[child]:
                waiting.append(child)
    return any(above.values())


def _circles(parents: dict[str, Joint]) -> list[Joint]:
    """Yield one joint of each circle; every link is visited once."""
    settled: set[str] = set()
    found: list[Joint] = []
    for start in parents:
        path: dict[str, Joint] = {}
        link = start
        while link in parents and link not in settled and link not in path:
            path[link] = parents[link]
            link = parents[link].parent or ""
        if link in path and path[link].parent != link:  # a joint of one link with itself has a rule of its own
            found.append(path[link])
        settled.update(path)
    return found
