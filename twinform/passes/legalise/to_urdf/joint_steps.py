"""Degrees of freedom of SDF joints, in order, in the joint frame."""

import math
from typing import NamedTuple

from twinform.ir import Axis, Dynamics, Format, Joint, JointType, Limit, Mimic
from twinform.ir.defaults import AXIS, UNLIMITED
from twinform.passes.carriers.joint_chains import BALL_AXES, metres_per_radian

_Z = Axis.unchecked(xyz=AXIS[Format.SDF])


class ChainStep(NamedTuple):
    """One joint of a chain."""

    type: JointType
    axis: Axis


def two_axes(joint: Joint) -> tuple[ChainStep, ...]:
    """A universal or revolute2 joint: it turns about `axis`, which the parent holds, then about `axis2` of the child.

    A turn about an axis leaves the axis where it is, so `axis2` has one direction in the link between and in the child.
    """
    return (ChainStep("revolute", joint.axis or _Z), ChainStep("revolute", joint.axis2 or _Z))


def ball(joint: Joint) -> tuple[ChainStep, ...]:
    """A ball joint as turns about z, y and x: together Rz Ry Rx, the orientation that URDF writes as yaw, pitch, roll.

    Damping acts on the angular velocity of a ball joint, and here on the three rates, which are its parts while the
    angles are small.
    """
    written = joint.axis.dynamics if joint.axis else None
    damped = None
    if written is not None and (written.damping is not None or written.friction is not None):
        damped = Dynamics(damping=written.damping, friction=written.friction)
    return tuple(ChainStep("revolute", Axis(xyz=xyz, dynamics=damped)) for xyz in BALL_AXES)


def screw(joint: Joint) -> tuple[ChainStep, ...]:
    """A screw joint: it slides along its axis by `metres_per_radian` times the angle that it turns about it."""
    # SDF does not say whether the limits of a screw joint are angles or lengths. Drake and DART count
    # the angle, so the turning joint leads and has the limits in rad; the sliding one has them times
    # the pitch.
    axis = joint.axis or _Z
    ratio = metres_per_radian(joint) or 0.0
    slide = Axis(xyz=axis.xyz, limit=_slide_limit(axis.limit, ratio), mimic=Mimic(joint=joint.name, multiplier=ratio))
    return (ChainStep("prismatic", slide), ChainStep("revolute", axis))


def _slide_limit(limit: Limit | None, ratio: float) -> Limit:
    """Limits that the turn keeps already: its own, times the ratio."""
    values = limit or Limit()
    ends = sorted((_scaled(values.lower, -UNLIMITED, ratio), _scaled(values.upper, UNLIMITED, ratio)))
    speed = values.velocity if values.velocity is not None and values.velocity >= 0 else UNLIMITED
    return Limit(lower=ends[0], upper=ends[1], effort=UNLIMITED, velocity=min(UNLIMITED, speed * abs(ratio)))


def _scaled(value: float | None, unbounded: float, ratio: float) -> float:
    if value is None or not abs(value) < UNLIMITED:
        return math.copysign(UNLIMITED, unbounded * ratio)
    return value * ratio + 0.0
