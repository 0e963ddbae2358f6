"""Equalities of MJCF: a linear one of two joints as a mimic, `connect` and `weld` of two bodies as joints of a loop."""

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from twinform.compiler.input.mjcf.pieces import Piece, placed_at
from twinform.compiler.input.mjcf.remainders import RemainderKeeper, in_sections
from twinform.ir import Joint, JointType, Mimic, Pose
from twinform.ir.kinematic_tree import JointBetween
from twinform.ir.motion import taken_for_tree

_LINEAR = 2
"""The number of coefficients of a mimic."""


class JointFollowing(NamedTuple):
    """The joint that another one follows, and by which numbers."""

    leader: str
    offset: float
    multiplier: float


def following(piece: Piece) -> JointFollowing | None:
    """Return what an equality of joints says, where a mimic says the same; None where it is no such equality.

    Both joints count from their drawn positions there, as in SDF, so that `ref` moves nothing.
    """
    leader = piece.peek("joint2")
    coefficients = piece.peek_numbers("polycoef") or (0.0, 1.0)
    if piece.tag != "joint" or leader is None or piece.peek("active") == "false" or any(coefficients[_LINEAR:]):
        return None
    offset, multiplier = (*coefficients, 0.0, 0.0)[:_LINEAR]
    return JointFollowing(leader, offset, multiplier)


def mimic_of(piece: Piece, found: JointFollowing, leader: str) -> Mimic:
    """Take an equality of joints: the mimic of its follower, whose leader is called so in SDF."""
    for attribute in ("joint1", "joint2", "polycoef", "active"):
        piece.take(attribute)
    return Mimic.unchecked(joint=leader, multiplier=found.multiplier, offset=found.offset or None, source=piece.source)


def loop_of(piece: Piece, name: str, links: Mapping[str, str]) -> Joint | None:
    """The joint that an equality would close a loop by; None where it is none, or names sites, or is switched off.

    `links` has the names of links by those of bodies. A `connect` is a ball at `anchor`, in the frame of the first
    body; a `weld` is fixed where both bodies are drawn, unless it says another pose.
    """
    first, second = piece.peek("body1"), piece.peek("body2")
    if piece.tag not in {"connect", "weld"} or piece.peek("active") == "false":
        return None
    if first is None or second is None or first not in links or second not in links:
        return None
    if piece.tag == "weld" and _places(piece):
        return None
    kind: JointType = "ball" if piece.tag == "connect" else "fixed"
    return Joint.unchecked(name=name, type=kind, parent=links[first], child=links[second])


def places_beside_tree(loops: Iterable[Joint], joints: Iterable[Joint]) -> list[int]:
    """List the places of those loops that no reader takes for a joint of the tree that the `joints` make.

    SDF does not say which of its joints close loops. A weld that is taken for one of the tree would replace the joint
    that moves its body.
    """
    asked = [*map(_between, loops)]
    taken = {id(each) for each in taken_for_tree(map(_between, joints), asked)}
    return [place for place, each in enumerate(asked) if id(each) not in taken]


def lower_loop(piece: Piece, joint: Joint, keeper: RemainderKeeper) -> Joint:
    """Take an equality: the joint that closes its loop, with its anchor and what else it says."""
    for attribute in ("body1", "body2", "active", "name"):
        piece.take(attribute)
    at = placed_at(piece.numbers("anchor")).translation if piece.tag == "connect" else None
    pose = Pose.unchecked(xyz=at, relative_to=joint.parent) if at else None
    element = keeper.rest_element(piece)
    rest = in_sections({"equality": (element,)}) if element.attributes else ()
    return joint.copy(pose=pose, opaque=rest, source=piece.source)


def _between(joint: Joint) -> JointBetween:
    return JointBetween(joint.name, joint.type, joint.parent or "", joint.child or "", joint)


def _places(weld: Piece) -> bool:
    """Tell whether a weld holds the bodies elsewhere than they are drawn: its quaternion is not zero then."""
    return any(weld.peek_numbers("relpose")[3:])


def followers(equalities: Iterable[Piece]) -> dict[str, tuple[Piece, JointFollowing]]:
    """Return the equalities that are mimics by the names of their followers, each of which has one."""
    found: dict[str, tuple[Piece, JointFollowing]] = {}
    for piece in equalities:
        follower, said = piece.peek("joint1"), following(piece)
        if follower is not None and said is not None and follower != said.leader:
            found.setdefault(follower, (piece, said))
    return found
