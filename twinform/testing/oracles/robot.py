"""A robot as an engine sees it: names, limits, and numbers at sampled joint positions; URDF stripped for engines."""

import math
import zlib
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import TypeVar

import numpy as np
import numpy.typing as npt
from lxml import etree

from twinform.dataclass import dataclass

Part = TypeVar("Part")
Matrix = npt.NDArray[np.float64]
WORLD = "world"
GRAVITY = 9.81
SAMPLES = 5
_UNLIMITED = 1e15
"""SDF up to 1.9 has 1e16 where there is no limit, and some engines have the largest number that there is."""


@dataclass(frozen=True, slots=True)
class View:
    """Options for reading a model.

    `names` renames joints. Poses and gravity are relative to the link `reference`; if the model has no such link, to
    the world if something is joined to it, else to the root. Joints in `still` stay at zero and are left out.
    """

    names: Mapping[str, str] = field(default_factory=dict[str, str])
    reference: str = ""
    still: frozenset[str] = frozenset()
    count: int = SAMPLES

    def moving(self, joints: Iterable[tuple[str, Part]]) -> dict[str, Part]:
        """Return the joints by their new names, without those that stay still."""
        named = ((self.names.get(name, name), joint) for name, joint in joints)
        return {name: joint for name, joint in named if name not in self.still}


@dataclass(frozen=True, slots=True, eq=False)
class EngineBody:
    """A link's mass in kg, center of mass in m, and inertia about it in kg m2, along the axes of the reference."""

    mass: float
    center: Matrix
    inertia: Matrix


@dataclass(frozen=True, slots=True, eq=False)
class Sample:
    """A robot at one set of joint positions; links without mass have a pose and no body.

    The mass matrix is in the order of the robot's joints; `gravity` is the generalized force on each joint. `frames`
    are poses of the engine's frames that are no links.
    """

    poses: Mapping[str, Matrix]
    bodies: Mapping[str, EngineBody]
    mass_matrix: Matrix
    gravity: Mapping[str, float]
    frames: Mapping[str, Matrix] = field(default_factory=dict[str, Matrix])


@dataclass(frozen=True, slots=True, eq=False)
class EngineRobot:
    """What one engine sees in one file.

    `joints` have one degree of freedom and are moved in the samples; `others` have more, or are screws, and stay at
    zero. `welds` maps a link to the link that it is fixed to. If `lumped`, the engine weighs welded links together, and
    only the first of them has a body.
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
    """Return a limit, infinite if it is so large that it stands for none."""
    return math.copysign(math.inf, value) if abs(value) > _UNLIMITED else float(value)


def moved(pose: Matrix, mass: float, center: Matrix, inertia: Matrix) -> EngineBody:
    """Return the body of a link at a pose, given center of mass and inertia in the frame of the link."""
    turn = pose[:3, :3]
    return EngineBody(mass, pose[:3, 3] + turn @ center, turn @ inertia @ turn.T)


def pose(rotation: Matrix, translation: Matrix) -> Matrix:
    """Combine a rotation and a translation into a 4 x 4 matrix."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation, translation
    return matrix


def inverse(motion: Matrix) -> Matrix:
    """Return the inverse of a pose."""
    back = motion[:3, :3].T
    return pose(back, -back @ motion[:3, 3])


def position(joint: str, number: int) -> float:
    """Return a joint's position in rad or m in a sample; in the first sample all joints are at zero."""
    # It depends on the name only: a limit that differs is one finding, not another position of the whole robot.
    return 0.0 if number == 0 else spread(f"{joint}/{number}")


def spread(name: str) -> float:
    """Return a number from -1 to 1 that is always the same for a name."""
    return 2 * float(np.random.default_rng(zlib.crc32(name.encode())).uniform()) - 1


def lumped(robot: EngineRobot) -> EngineRobot:
    """Return the robot with one body for each group of welded links, named after the first link of the group."""
    samples = tuple(_lump_sample(sample, robot.welds) for sample in robot.samples)
    return replace(robot, samples=samples, lumped=True)


def _lump_sample(sample: Sample, welds: Mapping[str, str]) -> Sample:
    groups: dict[str, list[EngineBody]] = defaultdict(list)
    for link, body in sample.bodies.items():
        first = link
        while first in welds:
            first = welds[first]
        groups[first].append(body)
    return replace(sample, bodies={name: _weigh_together(bodies) for name, bodies in groups.items()})


def _weigh_together(parts: Sequence[EngineBody]) -> EngineBody:
    mass = sum(body.mass for body in parts)
    center = np.sum([body.mass * body.center for body in parts], axis=0) / mass
    inertia = np.zeros((3, 3))
    for body in parts:
        arm = body.center - center
        inertia += body.inertia + body.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return EngineBody(mass, center, inertia)


def without_shapes(path: Path) -> bytes:
    """Return the text of a URDF file without visuals and collisions.

    Raises:
        lxml.etree.XMLSyntaxError: the file is not XML.
    """
    # An engine that simulates loads every mesh, and a model from elsewhere rarely comes with its meshes.
    # Kinematics and inertia do not depend on shapes.
    parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True)
    robot = etree.parse(str(path), parser).getroot()
    for shape in [*robot.iterfind("link/visual"), *robot.iterfind("link/collision")]:
        parent = shape.getparent()
        assert parent is not None
        parent.remove(shape)
    return etree.tostring(robot, encoding="utf-8")


def root_link(text: bytes) -> str:
    """Return the first link of a URDF file that is no joint's child."""
    robot = etree.fromstring(text)
    children = {child.get("link") for child in robot.iterfind("joint/child")}
    names = (link.get("name", "") for link in robot.iterfind("link"))
    return next((name for name in names if name not in children), "")
