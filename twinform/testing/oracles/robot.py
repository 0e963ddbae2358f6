"""A robot as an engine sees it: names, limits, and numbers at sampled joint positions."""

import math
import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

Matrix = npt.NDArray[np.float64]
WORLD = "world"
GRAVITY = 9.81
SAMPLES = 5
_UNLIMITED = 1e15
"""SDF up to 1.9 has 1e16 where there is no limit, and some engines have the largest number that there is."""


@dataclass(frozen=True, slots=True)
class View:
    """Options for reading a model: other `names` for some joints, and the link that poses and gravity are relative to.

    Joints that are `still` stay at zero and are none of the robot's. Without a `reference`, or where the model does not
    have it, that is the world if something is joined to it, else the root.
    """

    names: Mapping[str, str] = field(default_factory=dict[str, str])
    reference: str = ""
    still: frozenset[str] = frozenset()
    count: int = SAMPLES


@dataclass(frozen=True, slots=True, eq=False)
class EngineBody:
    """The mass of a link in kg, its center in m, and its inertia about that in kg m2, along the axes of reference."""

    mass: float
    center: Matrix
    inertia: Matrix


@dataclass(frozen=True, slots=True, eq=False)
class Sample:
    """A robot at one set of joint positions; links without mass have a pose and no body.

    The mass matrix has the order of the robot's joints; gravity is the generalized force of it, by joint. `frames` are
    poses of what is no link to the engine, where it has such.
    """

    poses: Mapping[str, Matrix]
    bodies: Mapping[str, EngineBody]
    mass_matrix: Matrix
    gravity: Mapping[str, float]
    frames: Mapping[str, Matrix] = field(default_factory=dict[str, Matrix])


@dataclass(frozen=True, slots=True, eq=False)
class EngineRobot:
    """What one engine sees in one file.

    `joints` are those with one degree of freedom, and stand where the samples are; `others` are those with more, and
    screws, and stand at zero. `welds` tell which link is fixed to which. `lumped` is true where the
    engine weighs such links together, so that only the first of them has a body.
    """

    engine: str
    reference: str
    joints: tuple[str, ...]
    links: tuple[str, ...]
    limits: Mapping[str, Mapping[str, float]]
    samples: tuple[Sample, ...]
    welds: Mapping[str, str] = field(default_factory=dict[str, str])
    lumped: bool = False
    others: tuple[str, ...] = ()


def limit(value: float) -> float:
    """A limit, infinite where it is as good as none."""
    return math.copysign(math.inf, value) if abs(value) > _UNLIMITED else float(value)


def moved(pose: Matrix, mass: float, center: Matrix, inertia: Matrix) -> EngineBody:
    """The body of a link at a pose, from center and inertia in the frame of the link."""
    turn = pose[:3, :3]
    return EngineBody(mass, pose[:3, 3] + turn @ center, turn @ inertia @ turn.T)


def pose(rotation: Matrix, translation: Matrix) -> Matrix:
    """A rotation and a translation as one matrix."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation, translation
    return matrix


def inverse(motion: Matrix) -> Matrix:
    """The inverse of a pose."""
    back = motion[:3, :3].T
    return pose(back, -back @ motion[:3, 3])


def position(joint: str, number: int) -> float:
    """The position in rad or m of a joint in the sample of a number; in the first, all are at zero.

    By name only: a limit that differs is one finding, not another position of the whole robot.
    """
    return 0.0 if number == 0 else spread(f"{joint}/{number}")


def spread(name: str) -> float:
    """A number from -1 to 1 that belongs to a name."""
    return 2 * float(np.random.default_rng(zlib.crc32(name.encode())).uniform()) - 1
