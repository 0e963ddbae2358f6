"""What two robots of libsdformat 12 differ in: one that it made of URDF itself, and one that we made for it."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from twinform.testing.oracles.libsdformat import JointRow, LinkRow, RobotRow
from twinform.testing.oracles.libsdformat_robot import pose_matrix
from twinform.testing.oracles.robot import Matrix

TOLERANCE = 1e-9
_CONTINUOUS, _REVOLUTE = 2, 6
"""The numbers that libsdformat has for these kinds of joints."""
_UNLIMITED = 1e16


class Difference(NamedTuple):
    """One fact that is not the same: what kind of fact, of which part, and the two values as text."""

    kind: str
    part: str
    theirs: str
    ours: str

    def __str__(self) -> str:
        return f"{self.kind} of {self.part}: {self.theirs} there, {self.ours} here"

    @property
    def name(self) -> str:
        """The name of the link or joint that it is about, which stands last in its part."""
        return self.part.rsplit("'", 2)[-2] if "'" in self.part else self.part

    @property
    def short(self) -> str:
        """Without numbers, of which there may be twelve."""
        return f"{self.kind} of {self.part}" + (", missing there" if self.theirs == "missing" else "")

    def steep(self, near: float) -> bool:
        """Whether either of two poses turns the x axis to where z or -z was, by the cosine `near`."""
        rows = [numbers.split() for numbers in (self.theirs, self.ours)]
        return any(len(row) == _POSE and abs(float(row[9])) > near for row in rows)


_POSE = 12


def differences(theirs: RobotRow, ours: RobotRow) -> list[Difference]:
    """All of them, links first; numbers are the same up to 1e-9 of one, or of the larger number."""
    links = [{("link", repr(row["name"])): row for row in robot["links"]} for robot in (theirs, ours)]
    joints = [{("joint", repr(row["name"])): row for row in robot["joints"]} for robot in (theirs, ours)]
    found = [*_only(*links), *_only(*joints)]
    for key in links[0].keys() & links[1].keys():
        found += _link(" ".join(key), links[0][key], links[1][key])
    for key in joints[0].keys() & joints[1].keys():
        found += _joint(" ".join(key), joints[0][key], joints[1][key])
    return sorted(found)


def _only(theirs: Mapping[tuple[str, str], object], ours: Mapping[tuple[str, str], object]) -> Iterator[Difference]:
    """What one of the two lacks, by kind and part."""
    yield from (Difference(*key, "there", "missing") for key in theirs.keys() - ours.keys())
    yield from (Difference(*key, "missing", "there") for key in ours.keys() - theirs.keys())


def _link(part: str, theirs: LinkRow, ours: LinkRow) -> Iterator[Difference]:
    yield from _numbers("pose", part, _pose(theirs["pose"]), _pose(ours["pose"]))
    yield from _numbers("mass", part, np.array([theirs["mass"]]), np.array([ours["mass"]]))
    if theirs["mass"] or ours["mass"]:
        yield from _numbers("center of mass", part, np.array(theirs["center"][:3]), np.array(ours["center"][:3]))
        yield from _numbers("inertia", part, _tensor(theirs), _tensor(ours))
    shapes = [{(row["kind"], f"{row['name']!r} of {part}"): row for row in link["shapes"]} for link in (theirs, ours)]
    yield from _only(*shapes)
    for key in shapes[0].keys() & shapes[1].keys():
        poses = (_pose(each[key]["pose"]) for each in shapes)
        yield from _numbers(f"{key[0]} pose", " ".join(key), *poses)


def _joint(part: str, theirs: JointRow, ours: JointRow) -> Iterator[Difference]:
    if _kind(theirs) != _kind(ours):
        yield Difference("kind", part, str(theirs["kind"]), str(ours["kind"]))
    for key in ("parent", "child"):
        if theirs[key] != ours[key]:
            yield Difference(key, part, theirs[key], ours[key])
    yield from _numbers("pose", part, _pose(theirs["pose"]), _pose(ours["pose"]))
    if "axis" in theirs and "axis" in ours:
        yield from _numbers("axis", part, np.array(theirs["axis"]), np.array(ours["axis"]))
    limits = theirs.get("limits", {}), ours.get("limits", {})
    for key in sorted(limits[0].keys() & limits[1].keys()):
        yield from _numbers(key, part, _limit(key, limits[0][key]), _limit(key, limits[1][key]))


def _limit(key: str, value: float) -> Matrix:
    """A limit; a negative effort or speed is none, and so is a very large one."""
    if key in {"effort", "velocity"} and (value < 0 or value >= _UNLIMITED):
        return np.array([np.inf])
    return np.array([value])


def _kind(row: JointRow) -> int:
    """The kind of a joint; one that turns without limits is continuous, whichever type is written."""
    limits = row.get("limits", {})
    free = limits.get("lower", 0.0) <= -_UNLIMITED and limits.get("upper", 0.0) >= _UNLIMITED
    return _CONTINUOUS if row["kind"] == _REVOLUTE and free else row["kind"]


def _numbers(kind: str, part: str, theirs: Matrix, ours: Matrix) -> Iterator[Difference]:
    if np.array_equal(theirs, ours):
        return
    gap = float(np.abs(theirs - ours).max())
    if not gap <= TOLERANCE * max(1.0, float(np.abs(theirs).max()), float(np.abs(ours).max())):
        yield Difference(kind, part, _printed(theirs), _printed(ours))


def _printed(values: Matrix) -> str:
    return " ".join(f"{value:.10g}" for value in values.ravel())


def _pose(numbers: list[float]) -> Matrix:
    """A position and a rotation matrix in one row: the two quaternions of a rotation are the same."""
    matrix = pose_matrix(numbers)
    return np.concatenate([matrix[:3, 3], matrix[:3, :3].ravel()])


def _tensor(row: LinkRow) -> Matrix:
    """The inertia about the center of mass along the axes of the link, kg m^2."""
    xx, yy, zz, xy, xz, yz = row["moments"]
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    turn = pose_matrix(row["center"])[:3, :3]
    return turn @ inertia @ turn.T
