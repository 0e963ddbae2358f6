"""Forward kinematics of both robots at the same joint positions."""

import zlib
from collections.abc import Iterator, Mapping
from random import Random

from twinform.compiler.compare.findings import Base, Findings, Subject
from twinform.compiler.compare.joint_values import joint_type, number_of
from twinform.compiler.compare.robot import JointView, Robot
from twinform.compiler.compare.values import Delta, PoseValue, Text, gaps
from twinform.ir import Vector3
from twinform.ir.defaults import MULTIPLIER, SCREW_THREAD_PITCH
from twinform.ir.motion import FULL_TURN, slide, spanning_tree, turn
from twinform.ir.transform import Transform

KINEMATICS = "kinematics"
"""The group of differences in how links move."""
SAMPLES = 5
_AXES: tuple[Vector3, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_STILL = Transform()


def compare_kinematics(findings: Findings, a: Robot, b: Robot, bases: Mapping[str, Base]) -> None:
    """Report the link that is furthest from where it is in the other robot, over all samples."""
    worst: dict[str, tuple[Delta, str]] = {}
    one = Moving(a, {name: base.a for name, base in bases.items()})
    other = Moving(b, {name: base.b for name, base in bases.items()})
    names = [name for name in a.bodies if name in bases]
    for sample in range(SAMPLES):
        for name, pose, like in zip(names, one.poses(names, sample), other.poses(names, sample), strict=True):
            for gap in gaps(PoseValue(pose), PoseValue(like)):
                known = worst.get(gap.aspect)
                if findings.terms.differs(gap) and (known is None or known[0].absolute < gap.absolute):
                    worst[gap.aspect] = (gap, name)
    for gap, name in worst.values():
        message = f"link {name!r} is up to {gap.absolute:.3g} {gap.unit} elsewhere at sampled joint positions"
        places = (a.bodies[name].where, b.bodies[name].where)
        findings.gaps(Subject(KINEMATICS, name), "pose", [gap], places, message=message)


class Moving:
    """A robot whose joints stand somewhere; `bases` are the frames of its links that are looked at."""

    def __init__(self, robot: Robot, bases: Mapping[str, Transform]) -> None:
        self.robot = robot
        self.bases = bases
        self.hung = spanning_tree(robot.joints.values())
        self.roots: dict[str, str] = {}

    def poses(self, names: list[str], sample: int) -> Iterator[Transform]:
        """The frame of each link at the joint positions of a sample, in that of the root that it hangs from."""
        moved: dict[str, Transform] = {}
        for name in names:
            pose = self._moved(name, sample, moved).compose(self.bases[name])
            yield self.bases.get(self._root(name), _STILL).inverse().compose(pose)

    def _root(self, name: str) -> str:
        """The link that a link hangs from, noted for each one between them: a chain is gone through once."""
        path: list[str] = []
        while name in self.hung and name not in self.roots:
            path.append(name)
            name = self.hung[name].parent
        root = self.roots.get(name, name)
        self.roots.update(dict.fromkeys(path, root))
        return root

    def _moved(self, name: str, sample: int, moved: dict[str, Transform]) -> Transform:
        """How a link has moved from where it is with every joint at zero, in the model's frame."""
        path: list[str] = []
        while name not in moved and name in self.hung:
            path.append(name)
            name = self.hung[name].parent
        motion = moved.get(name, _STILL)
        for each in reversed(path):
            motion = moved[each] = motion.compose(self._motion(self.hung[each], sample))
        return motion

    def _motion(self, joint: JointView, sample: int) -> Transform:
        type, position = joint_type(joint.type), joint.frame.translation
        if type == "fixed":
            return _STILL
        if type == "prismatic":
            (axis,) = joint.axes
            return slide(axis, self._position(joint.name, 0, sample))
        axes = joint.axes
        if type == "ball":  # about axes that are the same in both robots
            axes = tuple(map(self.bases.get(joint.parent, _STILL).rotate, _AXES))
        turned = _STILL
        for number, axis in enumerate(axes):
            angle = self._position(joint.name, number, sample)
            turned = turned.compose(turn(axis, angle, position, self._advance(joint, angle)))
        return turned

    def _advance(self, joint: JointView, angle: float) -> float:
        """How far a screw goes."""
        if joint.type != "screw":
            return 0.0
        return angle / FULL_TURN * number_of(joint.leaves.get("screw_thread_pitch"), SCREW_THREAD_PITCH)

    def _position(self, name: str, axis: int, sample: int, depth: int = 0) -> float:
        """Where a joint stands: by its name alone, from -1 to 1, or where the joint is that it mimics."""
        joint = self.robot.joints.get(name)
        leader = joint.leaves.get(f"{_axis(axis)}/mimic/@joint") if joint else None
        if joint is None or leader is None or not isinstance(leader.value, Text) or depth > len(self.robot.joints):
            return Random(zlib.crc32(f"{name}/{axis}/{sample}".encode())).uniform(-1, 1)  # noqa: S311 - not a secret
        words = joint.leaves.get(f"{_axis(axis)}/mimic/@axis")
        second = words is not None and words.value == Text("axis2")
        multiplier, offset = (joint.leaves.get(f"{_axis(axis)}/mimic/{part}") for part in ("multiplier", "offset"))
        position = self._position(leader.value.text, int(second), sample, depth + 1)
        return number_of(multiplier, MULTIPLIER) * position + number_of(offset, 0.0)


def _axis(number: int) -> str:
    return "axis2" if number else "axis"
