"""How joints move: forward kinematics of one joint, as transforms of the frame that its axes are given in."""

import math
from collections.abc import Iterable, Mapping
from typing import Protocol, TypeVar

from twinform.ir.groups import Groups
from twinform.ir.joint import Axis, Joint
from twinform.ir.node import Vector3
from twinform.ir.scopes import SCOPE
from twinform.ir.transform import Transform, times

FULL_TURN = 2 * math.pi
WITHOUT_AXIS = frozenset({"fixed", "ball", "spherical", "floating"})
"""Types of joints whose `<axis>` means nothing."""
WITH_TWO_AXES = frozenset({"universal", "revolute2", "gearbox"})
"""Types of joints that turn about a second axis too."""
_ALONG = 1e-12
"""So close to -1 a cosine is that of the opposite direction."""


class JointEnds(Protocol):
    """A joint with the links that its ends move with."""

    @property
    def name(self) -> str:
        """Its own name."""
        ...

    @property
    def type(self) -> str:
        """What sort of joint it is."""
        ...

    @property
    def parent(self) -> str:
        """The link that it hangs from."""
        ...

    @property
    def child(self) -> str:
        """The link that it moves."""
        ...


AnyJoint = TypeVar("AnyJoint", bound=JointEnds)


def axes_of(joint: Joint) -> tuple[Axis, ...]:
    """Return the axes of a joint; an axis that is not written stands as an empty one."""
    if joint.type in WITHOUT_AXIS:
        return ()
    axes = (joint.axis, joint.axis2) if joint.type in WITH_TWO_AXES else (joint.axis,)
    return tuple(axis or Axis.unchecked() for axis in axes)


def spanning_tree(joints: Iterable[AnyJoint]) -> Mapping[str, AnyJoint]:
    """Choose the joints that make a tree, by child link: of several, the first one of the innermost model."""
    return _grown(joints)[0]


def taken_for_tree(joints: Iterable[AnyJoint], others: Iterable[AnyJoint]) -> list[AnyJoint]:
    """List which other joints would be part of the spanning tree of `joints`, each if it alone were added to them."""
    return _grown(joints, others)[1]


def _grown(joints: Iterable[AnyJoint], others: Iterable[AnyJoint] = ()) -> tuple[dict[str, AnyJoint], list[AnyJoint]]:
    above, taken, groups = dict[str, AnyJoint](), list[AnyJoint](), Groups()
    ranked = [*((joint, False) for joint in joints), *((joint, True) for joint in others)]
    # Engines build a nested model before what holds it, and take joints in the order of the file.
    for joint, is_other in sorted(ranked, key=lambda each: -each[0].name.count(SCOPE)):
        if joint.child in above or groups.find(joint.parent) == joint.child:
            continue
        if is_other:
            taken.append(joint)
        else:
            above[joint.child] = joint
            groups.join(joint.parent, joint.child)
    return above, taken


def slide(axis: Vector3, distance: float) -> Transform:
    """The motion of so many meters along a unit vector."""
    return Transform(times(axis, distance))


def turn(axis: Vector3, angle: float, center: Vector3, advance: float = 0.0) -> Transform:
    """The rotation by an angle in radians about the line through `center` along a unit vector, by Rodrigues' formula.

    `advance` is how many meters it moves along the line, as a screw does.
    """
    x, y, z = axis
    c, s = math.cos(angle), math.sin(angle)
    v = 1 - c
    rotation = (
        c + x * x * v, x * y * v - z * s, x * z * v + y * s,
        x * y * v + z * s, c + y * y * v, y * z * v - x * s,
        x * z * v - y * s, y * z * v + x * s, c + z * z * v,
    )  # fmt: skip
    back = Transform(rotation=rotation).rotate(center)
    shift = times(axis, advance)
    return Transform(
        (center[0] - back[0] + shift[0], center[1] - back[1] + shift[1], center[2] - back[2] + shift[2]), rotation
    )


def unit(vector: Vector3) -> Vector3:
    """The vector with length one; itself where it has no length."""
    length = math.hypot(*vector)
    if not length:
        return vector
    return (vector[0] / length, vector[1] / length, vector[2] / length)


def plane_across(normal: Vector3) -> tuple[Vector3, Vector3]:
    """Return two unit vectors that make a right-handed frame with a normal: x and y after the shortest turn of z to it.

    URDF leaves open where they are. Drake and MuJoCo have them so.
    """
    length = math.hypot(*normal)
    x, y, z = (part / length for part in normal)
    if 1.0 + z < _ALONG:  # every half turn about an axis in the plane is as short
        return (1.0, 0.0, 0.0), (0.0, -1.0, 0.0)
    both = -x * y / (1.0 + z) + 0.0
    return (1.0 - x * x / (1.0 + z), both, -x + 0.0), (both, 1.0 - y * y / (1.0 + z), -y + 0.0)
