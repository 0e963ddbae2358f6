"""Degrees of freedom of joints: axes in the frame of the world, ranges, and which joint they follow."""

import math
from collections.abc import Callable, Iterator

from twinform.compiler.kinematics.placed_joints import Degree, Leader
from twinform.ir import Axis, Format, Joint, Mimic, Vector3
from twinform.ir.defaults import SCREW_THREAD_PITCH, UNLIMITED, direction, multiplier, with_range
from twinform.ir.motion import FULL_TURN, axes_of, plane_across, unit
from twinform.ir.transform import Transform

_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_BALLS = frozenset({"ball", "spherical"})
_SECOND = "axis2"


def degrees_of(
    joint: Joint, frame: Transform, format: Format, place: Callable[[str], Transform], prefix: str = ""
) -> Iterator[Degree]:
    """How a joint at a frame moves, the axes nearest to its parent first; a floating joint moves without limits.

    `place` gives the frames that axes are expressed in, and `prefix` stands before the names of the joints it follows.

    Raises:
        FrameError: an axis is expressed in a frame that is not known.
    """
    if joint.type in _BALLS:
        for axis in _AXES:
            yield Degree(unit(frame.rotate(axis)), slides=False, lower=-math.inf, upper=math.inf)
    for axis in axes_of(joint):
        turned = place(axis.expressed_in) if axis.expressed_in else frame
        along = direction(axis, format)
        if any(along):
            yield from _in_plane(joint, along, turned)
            yield _degree(joint, axis, unit(turned.rotate(along)), prefix, format)


def _in_plane(joint: Joint, normal: Vector3, turned: Transform) -> Iterator[Degree]:
    """The two ways in which a planar joint slides before it turns."""
    if joint.type == "planar":
        for axis in plane_across(normal):
            yield Degree(turned.rotate(axis), slides=True, lower=-math.inf, upper=math.inf)


def _degree(joint: Joint, axis: Axis, along: Vector3, prefix: str, format: Format) -> Degree:
    lower, upper = range_of(joint, axis, format)
    return Degree(
        along,
        slides=joint.type == "prismatic",
        lower=lower,
        upper=upper,
        pitch=_pitch(joint) if joint.type == "screw" else 0.0,
        leader=_leader(axis.mimic, prefix),
    )


def range_of(joint: Joint, axis: Axis, format: Format) -> tuple[float, float]:
    """Return the limits of an axis, infinite where it has none."""
    if axis.limit is None or joint.type == "continuous":
        return -math.inf, math.inf
    limit = with_range(axis.limit, format)
    lower, upper = limit.lower or 0.0, limit.upper or 0.0
    return lower if lower > -UNLIMITED else -math.inf, upper if upper < UNLIMITED else math.inf


def _pitch(joint: Joint) -> float:
    """In m per turn, right-handed; the older one is in rad/m, left-handed."""
    if joint.screw_thread_pitch is not None:
        return joint.screw_thread_pitch
    return -FULL_TURN / joint.thread_pitch if joint.thread_pitch else SCREW_THREAD_PITCH


def _leader(mimic: Mimic | None, prefix: str) -> Leader | None:
    if mimic is None or not mimic.joint:
        return None
    degree = int(mimic.axis == _SECOND)
    return Leader(prefix + mimic.joint, degree, multiplier(mimic), mimic.offset or 0.0, mimic.reference or 0.0)
