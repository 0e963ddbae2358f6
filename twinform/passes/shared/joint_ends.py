"""What joints connect: frames, which become links, and the two joints whose angles a gearbox of SDF couples."""

import math
from collections.abc import Container, Mapping
from typing import NamedTuple

from twinform.diagnostics import DiagnosticSink, rules
from twinform.ir import Axis, Format, Joint, Mimic, Opaque, Pose
from twinform.ir.defaults import GEARBOX_RATIO, direction
from twinform.ir.frames import FrameGraph
from twinform.ir.node import Vector3
from twinform.passes.carriers.annotations import find_annotation
from twinform.passes.shared.nodes import text_piece
from twinform.passes.shared.poses import pose_attributes

ENDS = "ends"
"""The annotation on a joint that connected frames: `<tf:ends parent="mount" child="flange"/>`."""


def resolve_ends(joint: Joint, links: Container[str], graph: FrameGraph) -> tuple[Joint, list[Opaque]]:
    """The joint between the links that its ends move with, and the replaced ends as carrier pieces.

    The joint stays in place: where its child changes, its pose names the frame that it was relative to.

    Raises:
        FrameError: an end is not known.
    """
    changed: dict[str, object] = {}
    pieces: list[Opaque] = []
    for end, name in (("parent", joint.parent), ("child", joint.child)):
        if name is None or name in links:
            continue
        body = graph.body(name, source=joint.source)
        if body != name:
            changed[end] = body
            pieces.append(text_piece(end, name))
    # A joint without a frame is posed in its child, which changes to another link here.
    if "child" in changed and not (joint.pose and joint.pose.relative_to):
        changed["pose"] = (joint.pose or Pose.unchecked()).copy(relative_to=joint.child)
    return (joint.copy(**changed) if changed else joint), pieces


def joint_pose_attributes(joint: Joint) -> dict[str, str | None]:
    """The attributes of the annotation on the pose of a joint whose ends may have been resolved."""
    attributes = pose_attributes(joint.pose)
    ends = find_annotation(joint, ENDS)
    if ends is not None and attributes.get("relative_to") == ends.get("child"):
        attributes.pop("relative_to", None)  # the default, once the child is back
    return attributes


def report_self_joint(joint: Joint, resolved: Joint, sink: DiagnosticSink) -> None:
    """Report a joint whose ends move with one link."""
    message = f"both ends of joint {joint.name!r} move with link {resolved.child!r}"
    sink.report(rules.SELF_JOINT, message, joint.location, found=joint.child)


def describe_ends(joint: Joint, pieces: list[Opaque]) -> str:
    """Say in a message which ends of a joint are replaced."""
    ends = " and ".join(repr(piece.element.text) for piece in pieces if piece.element)
    return f"joint {joint.name!r} is attached to {ends}; what is written is the link that carries it"


_TURNS = frozenset({"revolute", "continuous"})
_PARALLEL = 1e-9
"""How far the cosine between two parallel axes may be from 1."""


GEARED = "geared"
"""The annotation on a joint that mimics because a gearbox couples it: `<tf:geared/>`."""


class Relation(NamedTuple):
    """The joint `follower` turns `multiplier` times as far as `leader`."""

    leader: str
    follower: str
    multiplier: float


class UngearedError(Exception):
    """The angles that a gearbox couples are not those of two joints."""


def relation(gearbox: Joint, joints: Mapping[str, Joint], graph: FrameGraph) -> Relation:
    """The relation of two joints that a gearbox couples; `joints` are all joints by name.

    theta_2 = -ratio theta_1: theta_1 is the angle from the reference body to the gearbox's parent about `axis`, theta_2
    the one to its child about `axis2` (the SDF description of <joint>, gearbox_reference_body). So the two bodies must
    be joined to the reference body, each by a joint that turns about that axis, one way or the other.

    Raises:
        UngearedError: there are no such joints.
        FrameError: an end is not known.
    """
    reference = gearbox.gearbox_reference_body
    if not reference:
        raise UngearedError("it names no reference body")
    leader, forth = _turn(gearbox, gearbox.parent, gearbox.axis, joints, graph)
    follower, back = _turn(gearbox, gearbox.child, gearbox.axis2, joints, graph)
    # A joint has one <mimic>, and can follow no second joint.
    if _mimic(joints[follower]):
        raise UngearedError(f"joint {follower!r} mimics another already")
    if _follows(leader, follower, joints):
        raise UngearedError(f"joint {leader!r} follows {follower!r} already")
    ratio = GEARBOX_RATIO if gearbox.gearbox_ratio is None else gearbox.gearbox_ratio
    # Adding 0.0 turns -0.0 into 0.0, which a file would show as "-0".
    return Relation(leader, follower, -ratio * forth * back + 0.0)


def _turn(
    gearbox: Joint, body: str | None, axis: Axis | None, joints: Mapping[str, Joint], graph: FrameGraph
) -> tuple[str, float]:
    """The joint that turns a body against the reference body about an axis, and the sign of its angle."""
    reference = gearbox.gearbox_reference_body
    for joint in joints.values():
        if joint.type not in _TURNS or {joint.parent, joint.child} != {reference, body}:
            continue
        turn = graph.pose(joint.name, gearbox.name, kind="joint", base="joint")
        cosine = _cosine(turn.rotate(direction(joint.axis, Format.SDF)), direction(axis, Format.SDF))
        if abs(abs(cosine) - 1) > _PARALLEL:
            raise UngearedError(f"joint {joint.name!r} turns about another axis")
        # A joint may be written from the reference body to the end or the other way round, about
        # the axis or against it.
        sign = 1.0 if cosine > 0 else -1.0
        return joint.name, sign if joint.parent == reference else -sign
    raise UngearedError(f"no joint turns {body!r} at {reference!r}")


def _cosine(one: Vector3, other: Vector3) -> float:
    dot = sum(a * b for a, b in zip(one, other, strict=True))
    lengths = math.hypot(*one) * math.hypot(*other)
    return dot / lengths if lengths else 0.0


def _mimic(joint: Joint | None) -> Mimic | None:
    return joint.axis.mimic if joint and joint.axis else None


def _follows(leader: str, follower: str, joints: Mapping[str, Joint]) -> bool:
    """Whether the leader mimics the follower, directly or through other joints."""
    seen: set[str] = set()
    name = leader
    while name not in seen:
        if name == follower:
            return True
        seen.add(name)
        mimic = _mimic(joints.get(name))
        name = (mimic.joint if mimic else None) or name
    return False
