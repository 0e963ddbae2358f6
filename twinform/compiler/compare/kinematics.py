"""Forward kinematics of both robots at the same joint positions."""

import math
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import replace
from random import Random

from twinform.compiler.compare.collect_differences import Base, ComparedSubject, ComparisonFindings
from twinform.compiler.compare.compared_robot import ComparedRobot, JointView
from twinform.compiler.compare.compared_values import Delta, PoseValue, gaps
from twinform.compiler.kinematics import Degree, Kinematics, Positions
from twinform.ir import Vector3
from twinform.ir.groups import tops
from twinform.ir.transform import Transform

KINEMATICS = "kinematics"
"""The group of differences in how links move."""
SAMPLES = 5
_AXES: tuple[Vector3, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_STILL = Transform()


def compare_kinematics(
    findings: ComparisonFindings, a: ComparedRobot, b: ComparedRobot, bases: Mapping[str, Base]
) -> None:
    """Report the link that is furthest from where it is in the other robot, over all samples."""
    worst: dict[str, tuple[Delta, str]] = {}
    one = Moving(a, {name: base.a for name, base in bases.items()})
    other = Moving(b, {name: base.b for name, base in bases.items()})
    names = [name for name in a.bodies if name in bases]
    for sample in range(SAMPLES):
        positions = sampled_positions([*a.joints.values(), *b.joints.values()], sample)
        poses, likes = one.poses(positions), other.poses(positions)
        for name in names:
            for gap in gaps(PoseValue(poses[name]), PoseValue(likes[name])):
                known = worst.get(gap.aspect)
                if findings.terms.differs(gap) and (known is None or known[0].absolute < gap.absolute):
                    worst[gap.aspect] = (gap, name)
    for gap, name in worst.values():
        message = f"link {name!r} is up to {gap.absolute:.3g} {gap.unit} elsewhere at sampled joint positions"
        places = (a.bodies[name].where, b.bodies[name].where)
        findings.gaps(ComparedSubject(KINEMATICS, name), "pose", [gap], places, message=message)


class Moving:
    """A robot whose joints stand somewhere; `frames` are those of its links that are looked at."""

    def __init__(self, robot: ComparedRobot, frames: Mapping[str, Transform]) -> None:
        self.kinematics = Kinematics(frames, [_comparable(joint, frames) for joint in robot.joints.values()])
        self.roots = tops(frames, {name: joint.parent for name, joint in self.kinematics.hung.items()})

    def poses(self, positions: Positions) -> dict[str, Transform]:
        """The frame of each link at these joint positions, in that of the root that it hangs from."""
        frames, poses = self.kinematics.at_zero, self.kinematics.poses(positions)
        return {name: frames.get(self.roots[name], _STILL).inverse().compose(pose) for name, pose in poses.items()}


def _comparable(joint: JointView, frames: Mapping[str, Transform]) -> JointView:
    """The joint; a ball turns about axes that are the same in both robots."""
    if joint.type != "ball":
        return joint
    axes = map(frames.get(joint.parent, _STILL).rotate, _AXES)
    return replace(joint, degrees=tuple(Degree(axis, False, -math.inf, math.inf) for axis in axes))


def sampled_positions(joints: Iterable[JointView], sample: int) -> Positions:
    """Where each joint stands in a sample: by its name alone, from -1 to 1; also one that only a mimic names."""
    keys = dict.fromkeys((joint.name, number) for joint in joints for number in range(len(joint.degrees)))
    leaders = (degree.leader for joint in joints for degree in joint.degrees)
    keys |= dict.fromkeys((leader.joint, leader.degree) for leader in leaders if leader)
    return {key: Random(zlib.crc32(f"{key[0]}/{key[1]}/{sample}".encode())).uniform(-1, 1) for key in keys}  # noqa: S311 - not a secret
