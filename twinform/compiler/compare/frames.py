"""The comparison of named frames, which one file may have as links without mass."""

from collections.abc import Mapping

from twinform.compiler.compare.collect_differences import Base, ComparedSubject, ComparisonFindings
from twinform.compiler.compare.compared_robot import ComparedRobot, NamedFrame
from twinform.compiler.compare.compared_values import PoseValue, Text, show
from twinform.ir import Format

_MOST_PAIRS = 2_500
"""Of more frames, not each is held against each."""


def compare_frames(findings: ComparisonFindings, a: ComparedRobot, b: ComparedRobot, bases: Mapping[str, Base]) -> None:
    """Compare the frames of both robots; a link of the same name stands for a frame too."""
    nested = a.models | b.models
    for name, one in a.frames.items():
        if name in b.frames:
            _compare(findings, one, b.frames[name], bases, nested=name in nested)
    sides = ((a, b, True), (b, a, False))
    unmatched = [_without_like(findings, mine, other, bases, in_a=in_a) for mine, other, in_a in sides]
    twins = [_twins(findings, *each) for each in ((unmatched[0], a, b), (unmatched[1], b, a))]
    renamed = set(twins[0].values()) & set(twins[1].values())
    for only, twin_of, (mine, other, in_a) in zip(unmatched, twins, sides, strict=True):
        kept = {name: twin for name, twin in twin_of.items() if twin not in renamed}
        _report(findings, only, (mine, other), kept, in_a=in_a)


def _compare(
    findings: ComparisonFindings, one: NamedFrame, other: NamedFrame, bases: Mapping[str, Base], *, nested: bool = False
) -> None:
    subject, places = ComparedSubject("frame", one.name), (one.where, other.where)
    base = bases.get(one.body, Base())
    findings.values(subject, "attached_to", Text(one.body), Text(other.body), places)
    terms = findings.terms
    if nested:
        if terms.worst(PoseValue(one.pose), PoseValue(other.pose), base):
            findings.note(subject, "frame", f"the nested model {one.name!r} is expressed in another frame", places)
        return
    findings.values(subject, "pose", PoseValue(one.pose), PoseValue(other.pose), places, base)
    if one.was_link != other.was_link and not (one.lumped or other.lumped) and terms.format_a is not terms.format_b:
        there = terms.b if one.was_link else terms.a
        findings.note(subject, "", f"link {one.name!r}, which has no mass, is a frame in {there}", places)


def _without_like(
    findings: ComparisonFindings, robot: ComparedRobot, other: ComparedRobot, bases: Mapping[str, Base], *, in_a: bool
) -> list[NamedFrame]:
    """The frames that the other robot has neither as a frame nor as a link; a link is compared here."""
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
        _compare(findings, pair[0], pair[1], bases)
    return only_in_one


def _report(
    findings: ComparisonFindings,
    only_in_one: list[NamedFrame],
    robots: tuple[ComparedRobot, ComparedRobot],
    twins: Mapping[str, str],
    *,
    in_a: bool,
) -> None:
    """Frames of one robot: a note where nothing is lost with them, and nothing to say of joints that hold a frame."""
    lumped = _is_lumped(*robots)
    here, there = (findings.terms.a, findings.terms.b) if in_a else (findings.terms.b, findings.terms.a)
    for frame in only_in_one:
        subject, places = ComparedSubject("frame", frame.name), (frame.where, frame.where)
        if frame.name in twins:
            message = f"frame {frame.name!r} of {here} is where frame {twins[frame.name]!r} is"
            if not frame.was_joint:
                findings.note(subject, "", message, places)
        elif lumped and (frame.was_link or frame.was_joint):
            findings.note(subject, "", f"{frame.name!r} is a part of link {frame.body!r} in {there}", places)
        else:
            findings.only_in_one(subject, "", "frame", frame.where, in_a=in_a)


def _twins(
    findings: ComparisonFindings, only_in_one: list[NamedFrame], robot: ComparedRobot, other: ComparedRobot
) -> dict[str, str]:
    """For frames that one robot has: another one at the same place that both have, as fixed joints of URDF do."""
    shared = [frame for name, frame in robot.frames.items() if name in other.frames or name in other.bodies]
    if len(only_in_one) * len(shared) > _MOST_PAIRS:
        first = {_place(frame): frame.name for frame in reversed(shared)}
        return {frame.name: first[_place(frame)] for frame in only_in_one if _place(frame) in first}
    found: dict[str, str] = {}
    for frame in only_in_one:
        for like in shared:
            is_there = like.body == frame.body
            if is_there and not findings.terms.worst(PoseValue(frame.pose), PoseValue(like.pose)):
                found[frame.name] = like.name
                break
    return found


def _place(frame: NamedFrame) -> tuple[str, str]:
    """Where a frame is, to ten digits."""
    return frame.body, show(PoseValue(frame.pose))


def _is_lumped(robot: ComparedRobot, other: ComparedRobot) -> bool:
    """Whether the other file is what a reader makes of URDF that has no frames for the links that it merges."""
    formats = robot.format is Format.URDF and other.format is Format.SDF
    return formats and not robot.frames.keys() & other.frames.keys()
