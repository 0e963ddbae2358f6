"""Faults of libsdformat 12 by which it reads another robot than the URDF file has, found in the numbers or the file."""

import math

from testbed.lumping.differences import Difference
from twinform.ir import Joint, Model, Pose
from twinform.ir.transform import Transform
from twinform.testing.oracles.libsdformat import RobotRow

SNAPPED = "a pitch within 0.26 degrees of 90 is taken for 90"
DROPPED = "links without mass are dropped, with all that hangs on them"
STOPPED = "the rest of a link is left out after a part that urdfdom refuses"
SMALL = "a link so light that it is taken for massless is dropped"
CAUSES = {
    SNAPPED: "urdfdom's getRPY merges roll and yaw there [P143]; also where lumping composes poses",
    DROPPED: "silently in 12 [P006, P067, P072]",
    STOPPED: "its result is ignored, and nothing is reported [P140, P141, P043]",
    SMALL: "1e-7 kg was measured [P155]",
}
"""Each with where it was seen: the numbers are those of reference/libsdformat.md."""

_NEAR = math.cos(math.radians(0.3))
_POSES = frozenset({"pose", "visual pose", "collision pose"})
_LIGHT = 1e-5


def cause_of(difference: Difference, theirs: RobotRow, ours: RobotRow, model: Model) -> str:
    """The fault behind a difference; empty where none of the known ones is."""
    if difference.kind in {"link", "joint"} and difference.theirs == "missing":
        return _why_missing(difference, ours) or _massless_above(difference.name, model)
    if _stopped(difference, theirs, ours):
        return STOPPED
    if difference.kind in {*_POSES, "center of mass", "inertia", "axis"} and _is_steep(difference, model):
        return SNAPPED
    return ""


def _why_missing(difference: Difference, ours: RobotRow) -> str:
    """Whether the link, or one above it, has no mass."""
    masses = {row["name"]: row["mass"] for row in ours["links"]}
    above = {row["child"]: row["parent"] for row in ours["joints"]}
    child = next((row["child"] for row in ours["joints"] if row["name"] == difference.name), difference.name)
    light = ""
    while child in masses:
        if masses[child] <= 0:
            return DROPPED
        if masses[child] < _LIGHT:
            light = SMALL
        child = above.get(child, "")
    return light


def _massless_above(name: str, model: Model) -> str:
    """Whether a link above it in the file has no mass, which is a frame here."""
    masses = {link.name: link.inertial.mass if link.inertial else None for link in model.links}
    above = {joint.child: joint.parent or "" for joint in model.joints}
    here = next((joint.child or "" for joint in model.joints if joint.name == name), name)
    while here in above:
        if not masses.get(here):
            return DROPPED
        here = above[here]
    return ""


def _stopped(difference: Difference, theirs: RobotRow, ours: RobotRow) -> bool:
    """Whether a link there has fewer shapes than the file, or no inertia where the file has one."""
    if difference.kind not in {"visual", "collision", "inertia", "visual pose", "collision pose"}:
        return False
    there, here = (_shapes(robot, difference.name) for robot in (theirs, ours))
    return there is not None and here is not None and there < here


def _shapes(robot: RobotRow, name: str) -> int | None:
    return next((len(row["shapes"]) for row in robot["links"] if row["name"] == name), None)


def _is_steep(difference: Difference, model: Model) -> bool:
    """Whether an origin that the number depends on points straight up or down."""
    if difference.kind in _POSES and difference.steep(_NEAR):
        return True
    name = difference.name
    around = {joint.child: joint for joint in model.joints}
    return any(_steep(joint.pose) for joint in model.joints if _above(joint, name, around)) or _above_is_steep(
        name, difference, around
    )


def _above(joint: Joint, name: str, around: dict[str | None, Joint]) -> bool:
    """Whether a joint, by fixed joints alone, hangs on the link."""
    here: Joint | None = joint
    while here is not None and here.type == "fixed":
        if here.parent == name:
            return True
        here = around.get(here.parent)
    return False


def _above_is_steep(name: str, difference: Difference, around: dict[str | None, Joint]) -> bool:
    """Whether the path from the root to a link or joint has a steep origin, on which its pose depends."""
    if difference.kind != "pose":
        return False
    joint = next((each for each in around.values() if each.name == name), around.get(name))
    while joint is not None:
        if _steep(joint.pose):
            return True
        joint = around.get(joint.parent)
    return False


def _steep(pose: Pose | None) -> bool:
    return abs(Transform.from_pose(pose).rotation[6]) > _NEAR
