"""Planar joints as chains of two prismatic joints and one revolute joint."""

from typing import NamedTuple

from twinform.ir import Axis, Format, Joint, Link, Pose
from twinform.ir.defaults import direction
from twinform.ir.motion import plane_across
from twinform.passes.carriers.token_mass import TOKEN
from twinform.passes.legalise.to_sdf.unique_names import free_name

Names = tuple[str, str, str, str]
"""Those of the sliding joints and their links, in turns."""


class PlanarChain(NamedTuple):
    """Two sliding joints, each with the link that it moves, and the turning one, which keeps name and child."""

    links: tuple[Link, Link]
    joints: tuple[Joint, Joint, Joint]


def planar_names(joint: str, taken: set[str]) -> Names:
    """The names in the chain of a planar joint, each with a number if it is taken; they are from then on."""
    return (
        free_name(f"{joint}_x", taken),
        free_name(f"{joint}_x_link", taken),
        free_name(f"{joint}_y", taken),
        free_name(f"{joint}_y_link", taken),
    )


def planar_chain(joint: Joint, names: Names) -> PlanarChain:
    """The chain of a planar joint of URDF.

    All three axes are in the joint's frame, whose x and y span the plane where its normal is z. The links between have
    a token of mass, so that engines move them and the robot weighs what it weighed.
    """
    normal = direction(joint.axis, Format.URDF)
    along, across = plane_across(normal)
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
    turn = joint.copy(
        type="revolute",
        parent=second_link,
        pose=Pose(relative_to=second_link),
        axis=Axis(xyz=normal),
    )
    links = (
        # Any mass worth the name would change the mass matrix of the robot.
        Link(name=first_link, pose=Pose(relative_to=first), inertial=TOKEN, source=source),
        Link(name=second_link, pose=Pose(relative_to=second), inertial=TOKEN, source=source),
    )
    return PlanarChain(links, (slide, shift, turn))
