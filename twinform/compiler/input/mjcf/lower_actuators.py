"""What actuators of MJCF tell about joints: how hard they push. The actuators themselves stay as they are."""

from collections.abc import Iterable

from twinform.compiler.input.mjcf.lower_joints import is_limited
from twinform.compiler.input.mjcf.pieces import Piece

_SECTION = "actuator"


def efforts(actuators: Iterable[Piece]) -> dict[str, float]:
    """Return the greatest force in N or N m on each joint that is named by an actuator and limited by all of them."""
    found: dict[str, float] = {}
    endless: set[str] = set()
    for piece in actuators:
        joint = piece.peek("joint")
        if joint is None:
            continue
        force = _greatest_force(piece)
        if force is None:
            endless.add(joint)
        else:
            found[joint] = found.get(joint, 0.0) + force
    return {joint: force for joint, force in found.items() if joint not in endless and force > 0}


def _greatest_force(piece: Piece) -> float | None:
    """Return the greatest force of an actuator: of its own limit, or of a motor at the end of its control range."""
    gear = abs(next(iter(piece.peek_numbers("gear")), 1.0))
    if is_limited(piece, "forcelimited", "forcerange"):
        return gear * max(map(abs, piece.peek_numbers("forcerange")))
    if piece.tag == "motor" and is_limited(piece, "ctrllimited", "ctrlrange"):
        return gear * max(map(abs, piece.peek_numbers("ctrlrange")))
    return None
