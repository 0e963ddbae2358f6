"""URDF models as PyBullet reads them; it gets them without shapes, so that no mesh is missed.

PyBullet computes rotations with fewer digits than the others, so its tolerance is larger.
"""

import importlib
import math
import tempfile
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from lxml import etree

from twinform.testing.oracles.robot import (
    GRAVITY,
    EngineBody,
    EngineRobot,
    Matrix,
    Sample,
    View,
    inverse,
    limit,
    moved,
    pose,
    position,
    without_shapes,
)

_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


class _Joint(NamedTuple):
    """PyBullet's information on a joint, field by field (`getJointInfo`)."""

    number: int
    name: bytes
    kind: int
    first_position: int
    first_speed: int
    flags: int
    damping: float
    friction: float
    lower: float
    upper: float
    effort: float
    velocity: float
    link: bytes
    axis: Sequence[float]
    place: Sequence[float]
    turn: Sequence[float]
    parent: int


class _World:
    """A PyBullet world with one robot in it, once with a fixed root and once loose."""

    def __init__(self, path: Path) -> None:
        self.engine: Any = importlib.import_module("pybullet")
        self.client = self.engine.connect(self.engine.DIRECT)
        # else a file of the same name is not read again
        self.engine.setPhysicsEngineParameter(enableFileCaching=0, physicsClientId=self.client)
        load = partial(self.ask, "loadURDF", str(path), flags=self.engine.URDF_USE_INERTIA_FROM_FILE, of_robot=False)
        self.robot = load(useFixedBase=1)
        # a fixed root has no mass in PyBullet
        self.loose = load(useFixedBase=0)
        self.base = self.ask("getBodyInfo")[0].decode()
        self.joints = [_Joint(*self.ask("getJointInfo", number)) for number in range(self.ask("getNumJoints"))]

    def ask(self, question: str, *arguments: Any, of_robot: bool = True, **options: Any) -> Any:
        """Call one of PyBullet's functions on the robot."""
        first = (self.robot,) if of_robot else ()
        return getattr(self.engine, question)(*first, *arguments, physicsClientId=self.client, **options)

    def close(self) -> None:
        """Disconnect from the world, which ends it."""
        self.ask("disconnect", of_robot=False)


def read(path: Path, view: View) -> EngineRobot:
    """Read the robot of a file.

    Raises:
        Exception: PyBullet cannot read it.
    """
    with tempfile.TemporaryDirectory() as folder:
        stripped = Path(folder) / "robot.urdf"
        stripped.write_bytes(_add_inertias(without_shapes(path)))
        world = _World(stripped)
    try:
        return _robot(world, view)
    finally:
        world.close()


def _add_inertias(text: bytes) -> bytes:
    """Give every link without an inertia one of zero: PyBullet takes its mass for 1 kg, and nobody else does."""
    robot = etree.fromstring(text)
    for link in robot.iterfind("link"):
        if link.find("inertial") is None:
            inertial = etree.SubElement(link, "inertial")
            etree.SubElement(inertial, "mass", value="0")
            etree.SubElement(inertial, "inertia", dict.fromkeys(_MOMENTS, "0"))
    return etree.tostring(robot)


def _robot(world: _World, view: View) -> EngineRobot:
    moving = {world.engine.JOINT_REVOLUTE, world.engine.JOINT_PRISMATIC}
    joints = view.moving((joint.name.decode(), joint) for joint in world.joints if joint.kind in moving)
    numbers = {world.base: -1} | {joint.link.decode(): joint.number for joint in world.joints}
    reference = view.reference if view.reference in numbers else world.base
    origin = _poses(world, numbers[reference])[0]
    down = origin[:3, :3] @ np.array([0.0, 0.0, -GRAVITY])
    world.ask("setGravity", *down, of_robot=False)
    samples = (_sample(world, joints, numbers, inverse(origin), number) for number in range(view.count))
    return EngineRobot(
        engine="pybullet",
        reference=reference,
        joints=tuple(joints),
        links=tuple(numbers),
        limits={name: _limits(joint) for name, joint in joints.items()},
        samples=tuple(samples),
        welds=_welds(world, numbers),
    )


def _welds(world: _World, numbers: Mapping[str, int]) -> dict[str, str]:
    names = {number: name for name, number in numbers.items()}
    fixed = (joint for joint in world.joints if joint.kind == world.engine.JOINT_FIXED)
    return {joint.link.decode(): names[joint.parent] for joint in fixed}


def _limits(joint: _Joint) -> dict[str, float]:
    # PyBullet gives a joint without limits a lower one above the upper one
    endless = joint.lower > joint.upper
    return {
        "lower": -math.inf if endless else limit(joint.lower),
        "upper": math.inf if endless else limit(joint.upper),
        "velocity": limit(joint.velocity),
        "effort": limit(joint.effort),
        "damping": joint.damping,
        "friction": joint.friction,
    }


def _sample(
    world: _World, joints: Mapping[str, _Joint], numbers: Mapping[str, int], back: Matrix, sample: int
) -> Sample:
    for name, joint in joints.items():
        world.ask("resetJointState", joint.number, position(name, sample))
    # PyBullet wants a position for every joint that can move, in its own order
    names = {joint.number: name for name, joint in joints.items()}
    movable = sorted(joint.number for joint in world.joints if joint.first_speed >= 0)
    order = {number: place for place, number in enumerate(movable)}
    places = [position(names[number], sample) if number in names else 0.0 for number in movable]
    rows = [order[joint.number] for joint in joints.values()]
    rest = [0.0] * len(places)
    matrix = np.array(world.ask("calculateMassMatrix", places)) if places else np.zeros((0, 0))
    forces = world.ask("calculateInverseDynamics", places, rest, rest) if places else ()
    seen = {name: _poses(world, number) for name, number in numbers.items()}
    bodies = ((name, _body(world, number, back @ seen[name][1])) for name, number in numbers.items())
    return Sample(
        poses={name: back @ link for name, (link, _) in seen.items()},
        bodies={name: body for name, body in bodies if body.mass > 0},
        mass_matrix=matrix[np.ix_(rows, rows)],
        gravity={name: -float(forces[order[joint.number]]) for name, joint in joints.items()},
    )


def _body(world: _World, number: int, inertial: Matrix) -> EngineBody:
    known = world.engine.getDynamicsInfo(world.loose, number, physicsClientId=world.client)
    return moved(inertial, float(known[0]), np.zeros(3), np.diag(known[2]))


def _poses(world: _World, number: int) -> tuple[Matrix, Matrix]:
    """Return the pose of a link frame, and the pose of its inertia."""
    if number >= 0:
        state = world.ask("getLinkState", number, computeForwardKinematics=1)
        return _pose(world, state[4], state[5]), _pose(world, state[0], state[1])
    inertial = _pose(world, *world.ask("getBasePositionAndOrientation"))
    known = world.ask("getDynamicsInfo", -1)
    return inertial @ inverse(_pose(world, known[3], known[4])), inertial


def _pose(world: _World, place: Sequence[float], turn: Sequence[float]) -> Matrix:
    rotation = np.array(world.engine.getMatrixFromQuaternion(turn)).reshape(3, 3)
    return pose(rotation, np.array(place))
