"""Chains of URDF joints that stand for one joint of SDF: which there are, and how they are marked.

The last joint of a chain keeps the name and the child of the one that it stands for and says its type; the joints above
it, and the links between, say whose parts they are:

    <joint name="neck_axis" type="revolute" tf:part_of="neck">
    <link name="neck_axis_link" tf:part_of="neck"/>
    <joint name="neck" type="revolute" tf:type="universal">
"""

import math

from twinform.ir import Joint, JointType, Link, Opaque
from twinform.ir.node import Vector3
from twinform.passes.legalise.carrier import NAMESPACE

TYPE = f"{{{NAMESPACE}}}type"
"""The attribute of the last joint: the type of the joint that the chain stands for."""
PART_OF = f"{{{NAMESPACE}}}part_of"
"""The attribute of the other joints and of the links: the name of the last joint."""

CHAINS: dict[JointType, tuple[str, ...]] = {
    "universal": ("axis",),
    "revolute2": ("axis",),
    "ball": ("z", "y"),
    "screw": ("slide",),
}
"""The words that stand behind the name of the joint in those of the others, from the parent's side."""

BALL_AXES: tuple[Vector3, ...] = ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))
"""What the joints of a ball turn about: Rz Ry Rx is the orientation that URDF writes as yaw, pitch and roll."""

PITCHES: tuple[str, ...] = ("screw_thread_pitch", "thread_pitch")
"""The fields of a screw joint, and the elements, that say how it couples turning and sliding."""

TWO_AXES: frozenset[JointType] = frozenset({"universal", "revolute2"})


def type_mark(joint: Joint) -> Opaque:
    """The mark on the last joint of the chain of a joint."""
    return Opaque(attribute=(TYPE, joint.type))


def part_mark(name: str) -> Opaque:
    """The mark on the other parts of the chain of the joint of this name."""
    return Opaque(attribute=(PART_OF, name))


def marked(node: Joint | Link, mark: str) -> str | None:
    """What a mark says, if the node has it."""
    found = (part.attribute[1] for part in node.opaque if part.attribute and part.attribute[0] == mark)
    return next(found, None)


def is_chain_mark(part: Opaque) -> bool:
    """Whether an opaque part is one of the two marks."""
    return part.attribute is not None and part.attribute[0] in (TYPE, PART_OF)


def metres_per_radian(joint: Joint) -> float | None:
    """How far a screw joint moves along its axis for each radian; None where a pitch of 0 rad/m says nothing.

    `screw_thread_pitch` is in m per turn and wins; `thread_pitch` is in rad/m with the sign of a left-handed thread.
    Without either, SDF's default is 1 m per turn: the SDF description of <joint>.
    """
    if joint.screw_thread_pitch is None and joint.thread_pitch is not None:
        return -1.0 / joint.thread_pitch if joint.thread_pitch else None
    pitch = 1.0 if joint.screw_thread_pitch is None else joint.screw_thread_pitch
    return pitch / math.tau
