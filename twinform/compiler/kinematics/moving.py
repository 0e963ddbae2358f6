"""Forward kinematics: where the links of a robot are at given joint positions."""

from collections.abc import Iterable, Mapping
from typing import Generic, TypeVar

from twinform.compiler.kinematics.placed_joints import Leader, PlacedJoint
from twinform.ir.motion import FULL_TURN, slide, spanning_tree, turn
from twinform.ir.transform import Transform

AnyJoint = TypeVar("AnyJoint", bound=PlacedJoint)
Positions = Mapping[tuple[str, int], float]
"""Where joints are, in rad or m, by their names and the number of the degree of freedom; others are at zero."""

_STILL = Transform()


class Kinematics(Generic[AnyJoint]):
    """A tree of joints; of a loop, the joint that closes it does not move anything.

    `at_zero` are the frames of the links that are looked at, with all joints at zero.
    """

    def __init__(self, at_zero: Mapping[str, Transform], joints: Iterable[AnyJoint]) -> None:
        self.at_zero = at_zero
        self.joints = {joint.name: joint for joint in joints}
        self.hung = spanning_tree(self.joints.values())

    def poses(self, positions: Positions) -> dict[str, Transform]:
        """The frame of each link, in the frame that the joints are placed in."""
        moved: dict[str, Transform] = {}
        return {name: self._motion_of(name, positions, moved).compose(pose) for name, pose in self.at_zero.items()}

    def position(self, joint: str, degree: int, positions: Positions) -> float:
        """Where a joint is: as given, or as the joint that it follows says, in circles of these at zero."""
        followed: list[tuple[str, int]] = []
        key = (joint, degree)
        while (leader := self._leader(key)) is not None and key not in followed:
            followed.append(key)
            key = (leader.joint, leader.degree)
        value = 0.0 if key in followed else positions.get(key, 0.0)
        for each in reversed(followed):
            leader = self._leader(each)
            value = leader.followed(value) if leader else value
        return value

    def _leader(self, key: tuple[str, int]) -> Leader | None:
        name, degree = key
        joint = self.joints.get(name)
        return joint.degrees[degree].leader if joint and degree < len(joint.degrees) else None

    def _motion_of(self, link: str, positions: Positions, moved: dict[str, Transform]) -> Transform:
        """How a link has moved from where it is with every joint at zero."""
        path: list[str] = []
        while link not in moved and link in self.hung:
            path.append(link)
            link = self.hung[link].parent
        motion = moved.get(link, _STILL)
        for each in reversed(path):
            motion = moved[each] = motion.compose(self._motion(self.hung[each], positions))
        return motion

    def _motion(self, joint: PlacedJoint, positions: Positions) -> Transform:
        motion = _STILL
        for number, degree in enumerate(joint.degrees):
            position = self.position(joint.name, number, positions)
            if position == 0.0:
                continue
            if degree.slides:
                step = slide(degree.axis, position)
            else:
                step = turn(degree.axis, position, joint.frame.translation, position / FULL_TURN * degree.pitch)
            motion = motion.compose(step)
        return motion
