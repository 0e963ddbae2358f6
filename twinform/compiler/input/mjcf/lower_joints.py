"""Joints of MJCF as joints of SDF: hinges, slides and balls, in the frame of the body that they move.

Of actuators they take how hard these push; the actuators themselves stay as they are.
"""

import math
from collections.abc import Mapping

from twinform.compiler.input.mjcf.pieces import Piece
from twinform.compiler.input.mjcf.remainders import RemainderKeeper, holder
from twinform.ir import Axis, Dynamics, Joint, JointType, Limit, Mimic, Opaque, Pose
from twinform.ir.defaults import AXIS
from twinform.ir.document import Format
from twinform.ir.transform import rounded_number
from twinform.passes.legalise.to_mjcf.actuator_efforts import counts
from twinform.passes.legalise.to_mjcf.kept_mjcf import FORCE
from twinform.schemas import format_value

FREE = "free"
TYPES: Mapping[str, JointType] = {"hinge": "revolute", "slide": "prismatic", "ball": "ball"}


def joint_type(piece: Piece) -> str:
    """Return the type of a joint of MJCF."""
    return FREE if piece.tag == "freejoint" else piece.peek("type") or "hinge"


def lower_joint(
    piece: Piece, name: str, parent: str, child: str, mimic: Mimic | None, effort: float | None, keeper: RemainderKeeper
) -> Joint:
    """Build the joint of an element: in the frame of the child, whose drawn position is zero.

    `mimic` and `effort` come from other elements of the file: an equality, and the actuators.
    """
    kind = TYPES[piece.take("type") or "hinge"]
    xyz = piece.numbers("pos")
    pose = Pose.unchecked(xyz=(xyz[0], xyz[1], xyz[2])) if any(xyz) else None
    axis = _ball_axis(piece) if kind == "ball" else _axis(piece, mimic, effort, keeper)
    return Joint.unchecked(
        name=name,
        type=kind,
        parent=parent,
        child=child,
        pose=pose,
        axis=axis,
        opaque=_rest(piece, axis, keeper),
        source=piece.source,
    )


def _rest(piece: Piece, axis: Axis | None, keeper: RemainderKeeper) -> tuple[Opaque, ...]:
    """Return what is left of a joint, and that it has no limit of force itself where that of its actuators is said.

    The forces of these stand beside that, so that an effort which was edited is told from them.
    """
    element = keeper.rest_element(piece)
    effort = axis.limit.effort if axis is not None and axis.limit is not None else None
    if effort is not None and not is_limited(piece, *FORCE):
        force = dict(zip(FORCE, ("false", format_value((-effort, effort))), strict=True))
        others = tuple(pair for pair in element.attributes if pair[0] not in force)
        element = element.copy(attributes=(*others, *force.items()))
    return (holder(element),) if element.attributes else ()


def _ball_axis(piece: Piece) -> Axis | None:
    """Return the axis of a ball joint, which only its damping needs; its range and spring have no counterpart."""
    _take_unlimited(piece)
    piece.take("axis")  # which says nothing for a ball
    damping, friction = _damping(piece), piece.number("frictionloss")
    if not (damping or friction):
        return None
    dynamics = Dynamics.unchecked(damping=damping, friction=friction, source=piece.source)
    return Axis.unchecked(xyz=AXIS[Format.SDF], dynamics=dynamics, source=piece.source)


def _axis(piece: Piece, mimic: Mimic | None, effort: float | None, keeper: RemainderKeeper) -> Axis:
    # `ref` is the number that MuJoCo has for the drawn position, which is zero in SDF: what is
    # counted from it is moved, and it stays in the remainder.
    ref = next(iter(piece.peek_numbers("ref")), 0.0)
    if ref == 0:
        piece.take("ref")
    x, y, z = piece.numbers("axis") or AXIS[Format.SDF]
    return Axis.unchecked(
        xyz=(x, y, z),
        limit=_limit(piece, ref, effort, keeper),
        dynamics=_dynamics(piece, ref),
        mimic=mimic,
        source=piece.source,
    )


def _limit(piece: Piece, ref: float, effort: float | None, keeper: RemainderKeeper) -> Limit | None:
    lower, upper = _range(piece, ref)
    own = _own_effort(piece, keeper)
    effort = effort if own is None else own
    if lower is None and upper is None and effort is None:
        return None
    return Limit.unchecked(lower=lower, upper=upper, effort=effort, source=piece.source)


def _range(piece: Piece, ref: float) -> tuple[float | None, float | None]:
    """Return the ends of the range counted from the drawn position; none where the joint is not limited."""
    if not is_limited(piece):
        _take_unlimited(piece)
        return None, None
    piece.take("limited")
    least, most = piece.numbers("range")
    lower, upper = (rounded_number(least - ref), rounded_number(most - ref)) if ref else (least, most)
    return (lower if math.isfinite(lower) else None), (upper if math.isfinite(upper) else None)


def is_limited(piece: Piece, limited: str = "limited", range_: str = "range") -> bool:
    """Tell whether a range counts: where that is said, and otherwise where it is one."""
    return counts(piece.peek, limited, range_)


def _take_unlimited(piece: Piece) -> None:
    """Take `limited="false"` where no range stands beside it that would limit the joint without it."""
    if not is_limited(piece) and not any(piece.peek_numbers("range")):
        piece.take("limited")
        piece.take("range")


def _own_effort(piece: Piece, keeper: RemainderKeeper) -> float | None:
    """Return the greatest force of all actuators, if the joint has a limit of it."""
    if not is_limited(piece, *FORCE):
        return None
    least, most = piece.numbers("actuatorfrcrange")
    if least == -most:
        piece.take("actuatorfrclimited")
    else:
        message = f"joint {piece.name!r} takes forces from {least:g} to {most:g}, and SDF has one number for both"
        keeper.approximate(message, piece.location.at("@actuatorfrcrange"))
        piece.leave("actuatorfrcrange")
    return max(abs(least), abs(most))


def _dynamics(piece: Piece, ref: float) -> Dynamics | None:
    damping, friction = _damping(piece), piece.number("frictionloss")
    stiffness = _first_coefficient(piece, "stiffness")
    reference = None
    if stiffness:
        reference = rounded_number((piece.number("springref") or 0.0) - ref)
    elif not any(piece.peek_numbers("springref")):
        piece.take("springref")
    if damping is None and friction is None and stiffness is None:
        return None
    return Dynamics.unchecked(
        damping=damping,
        friction=friction,
        spring_stiffness=stiffness,
        spring_reference=reference,
        source=piece.source,
    )


def _damping(piece: Piece) -> float | None:
    return _first_coefficient(piece, "damping")


def _first_coefficient(piece: Piece, attribute: str) -> float | None:
    """Take a coefficient that may be the first of a polynomial, whose others stay in the remainder."""
    numbers = piece.numbers(attribute)
    if any(numbers[1:]):
        piece.leave(attribute)
    return numbers[0] if numbers else None
