"""Chains of URDF joints that represent one multi-axis SDF joint, and their annotations.

The last joint of a chain keeps the name and the child of the one that it stands for and names its type; the joints
above it, and the links between, name the joint whose parts they are:

    <joint name="neck_axis" type="revolute"><tf:part joint="neck"/>
    <link name="neck_axis_link"><tf:part joint="neck"/></link>
    <joint name="neck" type="revolute"><tf:chain type="universal"/>
"""

import math

from twinform.ir import Joint, JointType, Link
from twinform.ir.defaults import SCREW_THREAD_PITCH
from twinform.ir.node import Vector3
from twinform.passes.carriers.annotations import find_annotation

CHAIN = "chain"
"""The annotation on the last joint, with the type of the joint that the chain stands for."""
PART = "part"
"""The annotation on the other joints and on the links, with the name of the last joint."""

CHAINS: dict[JointType, tuple[str, ...]] = {
    "universal": ("axis",),
    "revolute2": ("axis",),
    "ball": ("z", "y"),
    "screw": ("slide",),
}
"""The suffixes that stand behind the name of the joint in those of the others, from the parent's side."""

BALL_AXES: tuple[Vector3, ...] = ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
"""What the joints of a ball turn about: Rz Ry Rx is the orientation that URDF writes as yaw, pitch and roll."""

PITCHES: tuple[str, ...] = ("screw_thread_pitch", "thread_pitch")
"""The fields of a screw joint, and the elements, that say how it couples turning and sliding."""

TWO_AXES: frozenset[JointType] = frozenset({"universal", "revolute2"})


def chain_type(joint: Joint) -> str | None:
    """The type of the joint that a chain stands for, if this is its last joint."""
    found = find_annotation(joint, CHAIN)
    return found.get("type") if found else None


def part_of(node: Joint | Link) -> str | None:
    """The name of the last joint of the chain, if the node is another part of it."""
    found = find_annotation(node, PART)
    return found.get("joint") if found else None


def metres_per_radian(joint: Joint) -> float | None:
    """How far a screw joint moves along its axis for each radian; None where the pitch is 0 rad/m.

    `screw_thread_pitch` is in m per turn and wins; `thread_pitch` is in rad/m with the sign of a left-handed thread.
    Without either, SDF's default is 1 m per turn: the SDF description of <joint>.
    """
    if joint.screw_thread_pitch is None and joint.thread_pitch is not None:
        return -1.0 / joint.thread_pitch if joint.thread_pitch else None
    pitch = SCREW_THREAD_PITCH if joint.screw_thread_pitch is None else joint.screw_thread_pitch
    return pitch / math.tau
