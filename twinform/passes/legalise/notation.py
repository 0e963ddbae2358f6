"""Poses in the notation that URDF and older versions of SDF have."""

import math

from twinform.ir import Pose
from twinform.ir.transform import Transform


def in_radians(transform: Transform, relative_to: str | None = None) -> Pose:
    """The pose as URDF and SDF before 1.9 write it: numbers that were read stay, angles are in radians."""
    written = transform.notation
    if written is None:
        return transform.to_pose(relative_to)
    rpy = written.rpy
    if written.quat_xyzw is not None:
        rpy = transform.rpy()
    elif written.degrees and rpy is not None:
        rpy = (math.radians(rpy[0]), math.radians(rpy[1]), math.radians(rpy[2]))
    return Pose(xyz=written.xyz, rpy=rpy, relative_to=relative_to, source=written.source)
