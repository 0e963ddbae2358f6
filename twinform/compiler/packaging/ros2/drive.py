"""Differential drives: whether the wheels of a model are one, and its measures."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from twinform.ir import Format, Model
from twinform.passes.plugins.wheels import NotMeasuredError, Wheel, radius_of, separation_of, wheel

_ALONG = 0.999
"""The cosine above which an axle lies across the way."""
_SAME_GROUND = 0.2
"""How far two wheels may end apart in height and stand on one ground, as a part of the radius."""


@dataclass(frozen=True, slots=True)
class Drive:
    """The joints of the wheels on both sides; how far these are apart, and the radius of a wheel, in m."""

    left: tuple[str, ...]
    right: tuple[str, ...]
    separation: float
    radius: float


def differential_drive(model: Model, joints: Sequence[str], others: Sequence[str], format_: Format) -> Drive:
    """The drive that joints with commanded velocities are: wheels that move the root along its x.

    `others` are the other joints that are commanded; they may steer no wheel.

    Raises:
        NotMeasuredError: they are none; the message has the reason.
    """
    wheels = {name: wheel(model, name, format_) for name in joints}
    for name, each in wheels.items():
        if each.axle[1] < _ALONG:
            raise NotMeasuredError(f"the axle of joint {name!r} does not point to the left, along y")
        turning = _turning_above(model, name, others)
        if turning:
            raise NotMeasuredError(f"joint {turning!r} moves the wheel of joint {name!r}")
    radius = radius_of(wheels.values())
    # Cars are told apart by a wheel on the same ground that turns with a commanded joint. A
    # caster's swivel is not commanded, and an arm's joints reach no ground.
    steered = _steered(model, min(each.center[2] for each in wheels.values()) - radius, others, format_)
    if steered:
        raise NotMeasuredError(f"the wheel of joint {steered!r} is steered")
    left, right = _sides(wheels)
    separation = separation_of([wheels[name] for name in left], [wheels[name] for name in right])
    return Drive(left, right, separation, radius)


def _sides(wheels: Mapping[str, Wheel]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    across = [each.center[1] for each in wheels.values()]
    middle = (min(across) + max(across)) / 2
    left = tuple(name for name, each in wheels.items() if each.center[1] > middle)
    right = tuple(name for name in wheels if name not in left)
    if len(left) != len(right):
        raise NotMeasuredError(f"there are {len(left)} wheels on the left and {len(right)} on the right")
    return left, right


def _steered(model: Model, ground: float, commanded: Sequence[str], format_: Format) -> str | None:
    """The joint of a wheel on this ground that turns with a joint that is commanded."""
    return next(
        (
            joint.name
            for joint in model.joints
            if joint.type == "continuous"
            and _turning_above(model, joint.name, commanded) in commanded
            and _stands(model, joint.name, ground, format_)
        ),
        None,
    )


def _stands(model: Model, joint: str, ground: float, format_: Format) -> bool:
    try:
        found = wheel(model, joint, format_)
    except NotMeasuredError:
        return False
    return found.radius is not None and abs(found.center[2] - found.radius - ground) < _SAME_GROUND * found.radius


def _turning_above(model: Model, name: str, commanded: Sequence[str]) -> str | None:
    """The nearest joint between the root and a joint that can move, but for suspensions, which nobody commands."""
    by_child = {joint.child: joint for joint in model.joints}
    at, seen = next(joint for joint in model.joints if joint.name == name).parent, set[str | None]()
    while at in by_child and at not in seen:
        seen.add(at)
        joint = by_child[at]
        if joint.type != "fixed" and (joint.type != "prismatic" or joint.name in commanded):
            return joint.name
        at = joint.parent
    return None
