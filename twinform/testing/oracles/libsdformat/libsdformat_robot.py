"""The robot that libsdformat sees: it resolves frames and reads URDF, and the kinematics here do the rest."""

import math
from pathlib import Path

import numpy as np

from twinform.testing.oracles.kinematics import EngineJoint, EngineLink, Motion, robot
from twinform.testing.oracles.libsdformat.library import JointRow, LinkRow, describe
from twinform.testing.oracles.lumping import lumped
from twinform.testing.oracles.robot import WORLD, EngineRobot, Matrix, View, limit, pose

_MOTIONS = {2: Motion.TURNS, 3: Motion.FIXED, 5: Motion.SLIDES, 6: Motion.TURNS}
"""The kinds of joints that move in one way or not at all, by the library's numbers for them."""
_CONTINUOUS = 2
_ENDLESS = {"lower": -math.inf, "upper": math.inf}
"""What a continuous joint has, whatever is written: in SDF its range has no ends."""


def read(path: Path, view: View) -> EngineRobot:
    """The first model of a file.

    Raises:
        RuntimeError: libsdformat has errors for it.
    """
    found = describe(path)
    links = [link_of(row) for row in found["links"]]
    joints = [joint_of(row) for row in found["joints"]]
    if found["static"]:
        joints += _held(links, joints)
    seen = robot("libsdformat", links, joints, pose_matrix(found["pose"]), view)
    # it weighs links together itself when it reads URDF
    return lumped(seen) if path.suffix == ".urdf" else seen


def _held(links: list[EngineLink], joints: list[EngineJoint]) -> list[EngineJoint]:
    """What holds the roots of a static model where they are."""
    children = {joint.child for joint in joints}
    roots = (link for link in links if link.name not in children)
    return [EngineJoint(link.name, Motion.FIXED, WORLD, link.name, link.pose, np.zeros(3), {}) for link in roots]


def link_of(row: LinkRow) -> EngineLink:
    """A link in the frame of its model."""
    xx, yy, zz, xy, xz, yz = row["moments"]
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return EngineLink(row["name"], pose_matrix(row["pose"]), row["mass"], pose_matrix(row["center"]), inertia)


def joint_of(row: JointRow) -> EngineJoint:
    """A joint in the frame of its model."""
    limits = {name: limit(value) for name, value in row.get("limits", {}).items()}
    if row["kind"] == _CONTINUOUS:
        limits |= _ENDLESS
    return EngineJoint(
        row["name"],
        _MOTIONS.get(row["kind"], Motion.OTHER),
        row["parent"],
        row["child"],
        pose_matrix(row["pose"]),
        np.array(row.get("axis", [0.0, 0.0, 1.0])),
        limits,
    )


def pose_matrix(numbers: list[float]) -> Matrix:
    """A pose as a 4 x 4 matrix, from a position and a quaternion with its real part first."""
    w, *vector = numbers[3:]
    x, y, z = vector
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return pose(np.eye(3) + 2 * w * skew + 2 * skew @ skew, np.array(numbers[:3]))
