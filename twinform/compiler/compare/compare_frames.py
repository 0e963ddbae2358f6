"""Compares named frames, which one file may have as massless links, and where links are when the joints move."""

import math
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import replace

from twinform.compiler.compare.compared_robot import ComparedRobot, JointView, NamedFrame
from twinform.compiler.compare.compared_values import Delta, PoseValue, Text, gaps, show
from twinform.compiler.compare.comparison import Base, ComparedSubject, ComparisonFindings
from twinform.compiler.kinematics import Degree, Kinematics, Positions
from twinform.ir import Format, Vector3
from twinform.ir.groups import tops
from twinform.ir.transform import Transform

_MOST_PAIRS = 2_500
"""With more pairs of frames than this, they are matched by a table instead of one by one."""


def compare_frames(findings: ComparisonFindings, a: ComparedRobot, b: ComparedRobot, bases: Mapping[str, Base]) -> None:
    """Compare the frames of both robots; a frame also matches a link of the same name."""
    nested = a.models | b.models
    for name, one in a.frames.items():
        if name in b.frames:
            _compare_pair(findings, one, b.frames[name], bases, nested=name in nested)
    sides = ((a, b, True), (b, a, False))
    unmatched = [_compare_with_links(findings, mine, other, bases, in_a=in_a) for mine, other, in_a in sides]
    twins = [_twins(findings, *each) for each in ((unmatched[0], a, b), (unmatched[1], b, a))]
    renamed = set(twins[0].values()) & set(twins[1].values())
    for only, twin_of, (mine, other, in_a) in zip(unmatched, twins, sides, strict=True):
        kept = {name: twin for name, twin in twin_of.items() if twin not in renamed}
        _report_unmatched(findings, only, (mine, other), kept, in_a=in_a)


def _compare_pair(
    findings: ComparisonFindings, one: NamedFrame, other: NamedFrame, bases: Mapping[str, Base], *, nested: bool = False
) -> None:
    subject, places = ComparedSubject("frame", one.name), (one.where, other.where)
    base = bases.get(one.body, Base())
    findings.compare_values(subject, "attached_to", Text(one.body), Text(other.body), places)
    terms = findings.terms
    if nested:
        if terms.worst(PoseValue(one.pose), PoseValue(other.pose), base):
            findings.add_note(subject, "frame", f"the nested model {one.name!r} is expressed in another frame", places)
        return
    findings.compare_values(subject, "pose", PoseValue(one.pose), PoseValue(other.pose), places, base)
    if one.was_link != other.was_link and not (one.lumped or other.lumped) and terms.format_a is not terms.format_b:
        there = terms.b if one.was_link else terms.a
        findings.add_note(subject, "", f"link {one.name!r}, which has no mass, is a frame in {there}", places)


def _compare_with_links(
    findings: ComparisonFindings, robot: ComparedRobot, other: ComparedRobot, bases: Mapping[str, Base], *, in_a: bool
) -> list[NamedFrame]:
    """Return the frames that the other robot has neither as frames nor as links, after comparing those with links."""
    only_in_one: list[NamedFrame] = []
    for name, frame in robot.frames.items():
        if name in other.frames or (frame.lumped and name not in other.bodies):
            continue
        body = other.bodies.get(name)
        if body is None:
            only_in_one.append(frame)
            continue
        like = NamedFrame(name, frame.body, body.frame, where=body.where)
        pair = (frame, like) if in_a else (like, frame)
        _compare_pair(findings, pair[0], pair[1], bases)
    return only_in_one


def _report_unmatched(
    findings: ComparisonFindings,
    only_in_one: list[NamedFrame],
    robots: tuple[ComparedRobot, ComparedRobot],
    twins: Mapping[str, str],
    *,
    in_a: bool,
) -> None:
    """Report frames that only one robot has: as a note where nothing is lost, or not at all for frames of joints."""
    lumped = _is_lumped(*robots)
    here, there = (findings.terms.a, findings.terms.b) if in_a else (findings.terms.b, findings.terms.a)
    for frame in only_in_one:
        subject, places = ComparedSubject("frame", frame.name), (frame.where, frame.where)
        if frame.name in twins:
            message = f"frame {frame.name!r} of {here} is where frame {twins[frame.name]!r} is"
            if not frame.was_joint:
                findings.add_note(subject, "", message, places)
        elif lumped and (frame.was_link or frame.was_joint):
            findings.add_note(subject, "", f"{frame.name!r} is a part of link {frame.body!r} in {there}", places)
        else:
            findings.add_one_sided(subject, "", "frame", frame.where, in_a=in_a)


def _twins(
    findings: ComparisonFindings, only_in_one: list[NamedFrame], robot: ComparedRobot, other: ComparedRobot
) -> dict[str, str]:
    """Map frames that only one robot has to a frame at the same place that both have, as fixed joints of URDF do."""
    shared = [frame for name, frame in robot.frames.items() if name in other.frames or name in other.bodies]
    if len(only_in_one) * len(shared) > _MOST_PAIRS:
        first = {_rounded_pose(frame): frame.name for frame in reversed(shared)}
        return {frame.name: first[_rounded_pose(frame)] for frame in only_in_one if _rounded_pose(frame) in first}
    found: dict[str, str] = {}
    for frame in only_in_one:
        for like in shared:
            is_there = like.body == frame.body
            if is_there and not findings.terms.worst(PoseValue(frame.pose), PoseValue(like.pose)):
                found[frame.name] = like.name
                break
    return found


def _rounded_pose(frame: NamedFrame) -> tuple[str, str]:
    """Return the link of a frame, and its pose to ten digits."""
    return frame.body, show(PoseValue(frame.pose))


def _is_lumped(robot: ComparedRobot, other: ComparedRobot) -> bool:
    """Whether the other file comes from a reader of URDF that merges links and leaves no frames in their places."""
    formats = robot.format is Format.URDF and other.format is Format.SDF
    return formats and not robot.frames.keys() & other.frames.keys()


KINEMATICS = "kinematics"
"""The group of differences in how links move."""
SAMPLES = 5
_AXES: tuple[Vector3, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_STILL = Transform()


def compare_kinematics(
    findings: ComparisonFindings, a: ComparedRobot, b: ComparedRobot, bases: Mapping[str, Base]
) -> None:
    """Report the link that is furthest from its place in the other robot, over all sampled joint positions."""
    worst: dict[str, tuple[Delta, str]] = {}
    one = Moving(a, {name: base.a for name, base in bases.items()})
    other = Moving(b, {name: base.b for name, base in bases.items()})
    names = [name for name in a.bodies if name in bases]
    for sample in range(SAMPLES):
        positions = sampled_positions([*a.joints.values(), *b.joints.values()], sample)
        poses, likes = one.poses(positions), other.poses(positions)
        for name in names:
            for gap in gaps(PoseValue(poses[name]), PoseValue(likes[name])):
                known = worst.get(gap.aspect)
                if findings.terms.differs(gap) and (known is None or known[0].absolute < gap.absolute):
                    worst[gap.aspect] = (gap, name)
    for gap, name in worst.values():
        message = f"link {name!r} is up to {gap.absolute:.3g} {gap.unit} elsewhere at sampled joint positions"
        places = (a.bodies[name].where, b.bodies[name].where)
        findings.add_gaps(ComparedSubject(KINEMATICS, name), "pose", [gap], places, message=message)


class Moving:
    """A robot whose joints can be moved; `frames` are the frames of its links with all joints at zero."""

    def __init__(self, robot: ComparedRobot, frames: Mapping[str, Transform]) -> None:
        self.kinematics = Kinematics(frames, [_comparable(joint, frames) for joint in robot.joints.values()])
        self.roots = tops(frames, {name: joint.parent for name, joint in self.kinematics.hung.items()})

    def poses(self, positions: Positions) -> dict[str, Transform]:
        """Return the frame of each link at these joint positions, relative to the root link above it."""
        frames, poses = self.kinematics.at_zero, self.kinematics.poses(positions)
        return {name: frames.get(self.roots[name], _STILL).inverse().compose(pose) for name, pose in poses.items()}


def _comparable(joint: JointView, frames: Mapping[str, Transform]) -> JointView:
    """Return the joint; one of type ball turns about axes of its parent link, which are the same in both robots."""
    if joint.type != "ball":
        return joint
    axes = map(frames.get(joint.parent, _STILL).rotate, _AXES)
    return replace(joint, degrees=tuple(Degree(axis, False, -math.inf, math.inf) for axis in axes))


def sampled_positions(joints: Iterable[JointView], sample: int) -> Positions:
    """Return a position from -1 to 1 for each joint, and each joint named by a mimic, that depends only on its name."""
    from random import Random  # noqa: PLC0415 - it brings hashes along

    keys = dict.fromkeys((joint.name, number) for joint in joints for number in range(len(joint.degrees)))
    leaders = (degree.leader for joint in joints for degree in joint.degrees)
    keys |= dict.fromkeys((leader.joint, leader.degree) for leader in leaders if leader)
    return {key: Random(zlib.crc32(f"{key[0]}/{key[1]}/{sample}".encode())).uniform(-1, 1) for key in keys}  # noqa: S311 - not a secret
