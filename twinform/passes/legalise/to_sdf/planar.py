"""Planar joints as chains of two prismatic joints and one revolute joint."""

import math
from typing import NamedTuple

from twinform.ir import Axis, Format, Joint, Link, Pose
from twinform.ir.defaults import direction
from twinform.ir.node import Vector3
from twinform.passes.carriers.token_mass import TOKEN


class Chain(NamedTuple):
    """Two sliding joints, each with the link that it moves, and the turning one, which keeps name and child."""

    links: tuple[Link, Link]
    joints: tuple[Joint, Joint, Joint]


def planar_chain(joint: Joint, names: tuple[str, str, str, str]) -> Chain:
    """The chain of a planar joint of URDF; `names` are for the sliding joints and their links, in turns.

    All three axes are in the joint's frame, whose x and y span the plane where its normal is z. The links between have
    a token of mass, so that engines move them and the robot weighs what it weighed.
    """
    normal = direction(joint.axis, Format.URDF)
    along, across = _plane(normal)
    first, first_link, second, second_link = names
    source = joint.source
    slide = Joint(
        name=first,
        type="prismatic",
        parent=joint.parent,
        child=first_link,
        pose=joint.pose,
        axis=Axis(xyz=along),
        source=source,
    )
    shift = Joint(
        name=second,
        type="prismatic",
        parent=first_link,
        child=second_link,
        pose=Pose(relative_to=first_link),
        axis=Axis(xyz=across),
        source=source,
    )
    turn = joint.model_copy(
        update={
            "type": "revolute",
            "parent": second_link,
            "pose": Pose(relative_to=second_link),
            "axis": Axis(xyz=normal),
        }
    )
    links = (
        Link(name=first_link, pose=Pose(relative_to=first), inertial=TOKEN, source=source),
        Link(name=second_link, pose=Pose(relative_to=second), inertial=TOKEN, source=source),
    )
    return Chain(links, (slide, shift, turn))


def _plane(normal: Vector3) -> tuple[Vector3, Vector3]:
    """Two directions that make a right-handed frame with the normal."""
    length = math.hypot(*normal)
    nx, ny, nz = (part / length for part in normal)
    smallest = min(range(3), key=lambda i: abs((nx, ny, nz)[i]))
    axis = [0.0, 0.0, 0.0]
    axis[smallest] = 1.0
    share = (nx, ny, nz)[smallest]
    ux, uy, uz = (axis[0] - share * nx, axis[1] - share * ny, axis[2] - share * nz)
    length = math.hypot(ux, uy, uz)
    ux, uy, uz = ux / length + 0.0, uy / length + 0.0, uz / length + 0.0
    return (ux, uy, uz), (ny * uz - nz * uy + 0.0, nz * ux - nx * uz + 0.0, nx * uy - ny * ux + 0.0)
