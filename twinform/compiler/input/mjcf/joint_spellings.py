"""Joints, ranges and mimics that MJCF writes otherwise than the source: back while they agree with the file."""

import math

from twinform.ir import Axis, Format, Joint, JointType, Limit, Mimic, Pose
from twinform.ir.defaults import direction, multiplier
from twinform.ir.transform import Transform, rounded
from twinform.passes.carriers.annotations import CONTINUOUS, find_annotation, without_annotation
from twinform.passes.carriers.mjcf_texts import TURN
from twinform.passes.carriers.said_by_mjcf import LIMITED
from twinform.passes.shared.poses import read_vector

CLOSE = 2e-9
"""How far a number may be from the one that was written: what a range of a single position is wide."""
_ALIKE: tuple[frozenset[JointType], ...] = (
    frozenset({"revolute", "continuous"}),
    frozenset({"universal", "revolute2"}),
    frozenset({"ball", "spherical"}),
)
"""Types of joints that are the same in MJCF."""
_UNDIRECTED = frozenset({"ball", "spherical"})
"""The types of joints that have an axis for its damping alone."""
_ENDLESS = frozenset({"continuous", *_UNDIRECTED})
"""The types of joints whose range means nothing."""


def with_motion(node: Joint, partial: Joint) -> tuple[Joint, Joint]:
    """The type, the frame and the range of the source, as far as the file has these in another way."""
    kept = without_annotation(_without_position(node, partial), TURN, CONTINUOUS)
    return _with_turn(_without_made_axis(_with_type(node, partial), partial), partial), kept


def _with_type(node: Joint, partial: Joint) -> Joint:
    """The joint with the type of the source, if MJCF has one word for both."""
    if not _are_alike(node.type, partial.type):
        return node
    limit = node.axis.limit if node.axis else None
    is_limited = limit is not None and (limit.lower is not None or limit.upper is not None)
    if partial.type == "continuous" and is_limited:
        return node
    return node.copy(type=partial.type)


def _without_made_axis(node: Joint, partial: Joint) -> Joint:
    """The joint without the direction that a ball was given with its damping, where the source has one."""
    if node.type not in _UNDIRECTED or node.axis is None or partial.axis is None or partial.axis.xyz is None:
        return node
    return node.copy(axis=node.axis.copy(xyz=None))


def _without_position(node: Joint, partial: Joint) -> Joint:
    """What is kept of a joint, without a range that would come to life.

    That is one which meant nothing for a joint of its type, where the file has another type, and the only position that
    the joint could be at, where the file has no range any more.
    """
    if partial.type in _ENDLESS and not _are_alike(node.type, partial.type):
        return partial.copy(axis=partial.axis and _without_ends(partial.axis))
    if partial.type not in LIMITED:
        return partial
    return partial.copy(axis=_let_go(node.axis, partial.axis), axis2=_let_go(node.axis2, partial.axis2))


def _are_alike(one: JointType, other: JointType) -> bool:
    return one == other or any({one, other} <= alike for alike in _ALIKE)


def _without_ends(axis: Axis) -> Axis:
    return axis if axis.limit is None else axis.copy(limit=axis.limit.copy(lower=None, upper=None))


def _let_go(axis: Axis | None, kept: Axis | None) -> Axis | None:
    limit = kept.limit if kept is not None else None
    if kept is None or limit is None or limit.lower is None or limit.lower != limit.upper:
        return kept
    own = axis.limit if axis is not None else None
    is_limited = own is not None and (own.lower is not None or own.upper is not None)
    return kept if is_limited else _without_ends(kept)


def _with_turn(node: Joint, partial: Joint) -> Joint:
    """The joint in the frame of the source, which is turned in its body."""
    note = find_annotation(partial, TURN)
    if note is None:
        return node
    try:
        rpy, xyz = read_vector(note.get("rpy")), read_vector(note.get("xyz"))
    except ValueError:
        return node
    back = Transform.from_pose(Pose.unchecked(rpy=rpy)).inverse()

    def turned_axis(axis: Axis | None) -> Axis | None:
        return axis and axis.copy(xyz=rounded(back.rotate(direction(axis, Format.SDF))))

    pose = (node.pose or Pose.unchecked()).copy(rpy=rpy)
    if note.get("xyz") and node.type == "prismatic":
        pose = pose.copy(xyz=xyz)
    return node.copy(pose=pose, axis=turned_axis(node.axis), axis2=turned_axis(node.axis2))


def with_reference(node: Mimic, partial: Mimic) -> tuple[Mimic, Mimic]:
    """The mimic of the source, if the polynomial of the file is that of it, and does not say all of it."""
    if partial.joint is None:
        return node, partial
    factor = multiplier(partial)
    offset = (partial.offset or 0.0) - factor * (partial.reference or 0.0)
    same = _is_close(multiplier(node), factor) and _is_close(node.offset or 0.0, offset)
    if same and (node.joint, node.axis or "axis") == (partial.joint, partial.axis or "axis"):
        return node.copy(joint=None, axis=None, multiplier=None, offset=None), partial
    return node, Mimic.unchecked()


def with_ends(node: Limit, partial: Limit) -> Limit:
    """The range without ends of a single position, which the file can only have wider."""
    ends = [(node.lower, partial.lower), (node.upper, partial.upper)]
    if any(own is None or kept is None or not _is_close(own, kept) for own, kept in ends):
        return node
    return node.copy(lower=None, upper=None)


def _is_close(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=1e-9, abs_tol=CLOSE)
