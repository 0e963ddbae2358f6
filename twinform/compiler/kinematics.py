"""How the links of a robot move with its joints: degrees of freedom, and forward kinematics."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Generic, TypeVar

from twinform.dataclass import dataclass
from twinform.ir import Axis, Format, Joint, Mimic, Vector3
from twinform.ir.defaults import SCREW_THREAD_PITCH, UNLIMITED, direction, multiplier, with_range
from twinform.ir.motion import FULL_TURN, axes_of, plane_across, slide, spanning_tree, turn, unit
from twinform.ir.transform import Transform

_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_BALLS = frozenset({"ball", "spherical"})
_SECOND = "axis2"
_STILL = Transform()


@dataclass(frozen=True, slots=True)
class Leader:
    """What a mimic follows: its position is `multiplier` (position of `joint` - `reference`) + `offset`."""

    joint: str
    degree: int
    multiplier: float
    offset: float
    reference: float

    def followed(self, position: float) -> float:
        """Return the position of the follower."""
        return self.multiplier * (position - self.reference) + self.offset


@dataclass(frozen=True, slots=True)
class Degree:
    """One degree of freedom of a joint: it turns about a unit vector, or slides along it.

    `pitch` is the distance in meters along the vector with each turn; `lower` and `upper` are infinite without limits.
    """

    axis: Vector3
    slides: bool
    lower: float
    upper: float
    pitch: float = 0.0
    leader: Leader | None = None


@dataclass(frozen=True, slots=True)
class PlacedJoint:
    """A joint between two links, or the world and a link, placed with all joints at zero."""

    name: str
    type: str
    parent: str
    child: str
    frame: Transform
    degrees: tuple[Degree, ...] = ()


AnyJoint = TypeVar("AnyJoint", bound=PlacedJoint)
Positions = Mapping[tuple[str, int], float]
"""Positions in rad or m, by the name of a joint and the number of its degree of freedom; others are at zero."""


class Kinematics(Generic[AnyJoint]):
    """A tree of joints; a joint that closes a loop moves nothing.

    `at_zero` has the frames of links, with all joints at zero.
    """

    def __init__(self, at_zero: Mapping[str, Transform], joints: Iterable[AnyJoint]) -> None:
        self.at_zero = at_zero
        self.joints = {joint.name: joint for joint in joints}
        self.hung = spanning_tree(self.joints.values())

    def poses(self, positions: Positions) -> dict[str, Transform]:
        """Return the frame of each link, in the frame that the joints are placed in."""
        moved: dict[str, Transform] = {}
        known: dict[tuple[str, int], float] = {}
        return {
            name: self._find_motion(name, positions, moved, known).compose(pose) for name, pose in self.at_zero.items()
        }

    def position(
        self, joint: str, degree: int, positions: Positions, known: dict[tuple[str, int], float] | None = None
    ) -> float:
        """Return the position of a joint: the given one, or what it mimics; zero if mimics go in a circle.

        `known` remembers the positions on the way, for the next call with the same `positions`.
        """
        known = {} if known is None else known
        followed: dict[tuple[str, int], Leader] = {}
        key = (joint, degree)
        while key not in known and key not in followed and (leader := self._find_leader(key)) is not None:
            followed[key] = leader
            key = (leader.joint, leader.degree)
        value = known[key] if key in known else 0.0 if key in followed else positions.get(key, 0.0)
        for each, leader in reversed(followed.items()):
            value = known[each] = leader.followed(value)
        return value

    def _find_leader(self, key: tuple[str, int]) -> Leader | None:
        name, degree = key
        joint = self.joints.get(name)
        return joint.degrees[degree].leader if joint and degree < len(joint.degrees) else None

    def _find_motion(
        self,
        link: str,
        positions: Positions,
        moved: dict[str, Transform],
        known: dict[tuple[str, int], float],
    ) -> Transform:
        """Return how a link has moved from its frame with every joint at zero."""
        path: list[str] = []
        while link not in moved and link in self.hung:
            path.append(link)
            link = self.hung[link].parent
        motion = moved.get(link, _STILL)
        for each in reversed(path):
            motion = moved[each] = motion.compose(self._compose_motion(self.hung[each], positions, known))
        return motion

    def _compose_motion(
        self, joint: PlacedJoint, positions: Positions, known: dict[tuple[str, int], float]
    ) -> Transform:
        motion = _STILL
        for number, degree in enumerate(joint.degrees):
            position = self.position(joint.name, number, positions, known)
            if position == 0.0:
                continue
            if degree.slides:
                step = slide(degree.axis, position)
            else:
                step = turn(degree.axis, position, joint.frame.translation, position / FULL_TURN * degree.pitch)
            motion = motion.compose(step)
        return motion


def degrees_of(
    joint: Joint, frame: Transform, format: Format, place: Callable[[str], Transform], prefix: str = ""
) -> Iterator[Degree]:
    """Yield the degrees of freedom of a joint at a frame, those nearest to its parent first.

    `place` returns the frames that axes are expressed in; `prefix` begins the names of joints that it mimics.

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
            yield from _make_planar_degrees(joint, along, turned)
            yield _make_degree(joint, axis, unit(turned.rotate(along)), prefix, format)


def _make_planar_degrees(joint: Joint, normal: Vector3, turned: Transform) -> Iterator[Degree]:
    """Yield the two directions in which a planar joint slides before it turns."""
    if joint.type == "planar":
        for axis in plane_across(normal):
            yield Degree(turned.rotate(axis), slides=True, lower=-math.inf, upper=math.inf)


def _make_degree(joint: Joint, axis: Axis, along: Vector3, prefix: str, format: Format) -> Degree:
    lower, upper = range_of(joint, axis, format)
    return Degree(
        along,
        slides=joint.type == "prismatic",
        lower=lower,
        upper=upper,
        pitch=_find_pitch(joint) if joint.type == "screw" else 0.0,
        leader=_make_leader(axis.mimic, prefix),
    )


def range_of(joint: Joint, axis: Axis, format: Format) -> tuple[float, float]:
    """Return the limits of an axis, infinite where it has none."""
    if axis.limit is None or joint.type == "continuous":
        return -math.inf, math.inf
    limit = with_range(axis.limit, format)
    lower, upper = limit.lower or 0.0, limit.upper or 0.0
    return lower if lower > -UNLIMITED else -math.inf, upper if upper < UNLIMITED else math.inf


def _find_pitch(joint: Joint) -> float:
    """Return the pitch of a screw in m per turn, right-handed; the older element is in rad/m, left-handed."""
    if joint.screw_thread_pitch is not None:
        return joint.screw_thread_pitch
    return -FULL_TURN / joint.thread_pitch if joint.thread_pitch else SCREW_THREAD_PITCH


def _make_leader(mimic: Mimic | None, prefix: str) -> Leader | None:
    if mimic is None or not mimic.joint:
        return None
    degree = int(mimic.axis == _SECOND)
    return Leader(prefix + mimic.joint, degree, multiplier(mimic), mimic.offset or 0.0, mimic.reference or 0.0)
