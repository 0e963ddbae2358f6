"""Forward kinematics, mass matrix and gravity of a tree of links, for a parser that has no physics of its own.

Poses are in the frame of the model, at the zero position of all joints; SI units.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum, auto

import numpy as np

from twinform.testing.oracles.robot import GRAVITY, WORLD, EngineRobot, Matrix, Sample, View, inverse, moved, position


class Motion(Enum):
    """How a joint moves its child; joints of `OTHER` types stay at zero."""

    FIXED = auto()
    TURNS = auto()
    SLIDES = auto()
    OTHER = auto()


@dataclass(frozen=True, slots=True, eq=False)
class EngineLink:
    """A link; `center` is the pose of its inertia in the link frame."""

    name: str
    pose: Matrix
    mass: float
    center: Matrix
    inertia: Matrix


@dataclass(frozen=True, slots=True, eq=False)
class EngineJoint:
    """A joint; `axis` is a unit vector in the joint's own frame."""

    name: str
    motion: Motion
    parent: str
    child: str
    pose: Matrix
    axis: Matrix
    limits: Mapping[str, float]

    @property
    def moves(self) -> bool:
        """Whether it has one degree of freedom."""
        return self.motion in {Motion.TURNS, Motion.SLIDES}


@dataclass(frozen=True, slots=True, eq=False)
class _KinematicTree:
    """The links by name, the joint above each link, and the moving joints by the names that the view gives them."""

    links: Mapping[str, EngineLink]
    above: Mapping[str, EngineJoint]
    moving: Mapping[str, EngineJoint]

    def shift(self, link: str, places: Mapping[str, float]) -> Matrix:
        """Return how far a link has moved from its zero position, as a motion in the frame of the model."""
        joint = self.above.get(link)
        if joint is None:
            return np.eye(4)
        before = self.shift(joint.parent, places) if joint.parent in self.links else np.eye(4)
        own = joint.pose @ _motion(joint, places.get(joint.name, 0.0)) @ inverse(joint.pose)
        return before @ own

    def chain(self, link: str) -> frozenset[str]:
        """Return the joints between a link and the root."""
        joint = self.above.get(link)
        return frozenset() if joint is None else self.chain(joint.parent) | {joint.name}


def robot(
    engine: str, links: Sequence[EngineLink], joints: Sequence[EngineJoint], model: Matrix, view: View
) -> EngineRobot:
    """Build the robot of these links and joints, whose model frame is at the pose `model` in the world."""
    moving = view.moving((joint.name, joint) for joint in joints if joint.moves)
    tree = _KinematicTree({link.name: link for link in links}, {joint.child: joint for joint in joints}, moving)
    reference = view.reference if view.reference in {*tree.links, WORLD} else _root(links, joints)
    # joints to the world say where in it a model stands; all others stand where their reference does
    origin = inverse(model) if reference == WORLD else tree.links[reference].pose
    samples = (_sample(tree, inverse(origin), number) for number in range(view.count))
    return EngineRobot(
        engine=engine,
        reference=reference,
        joints=tuple(moving),
        links=tuple(tree.links),
        limits={name: joint.limits for name, joint in moving.items()},
        samples=tuple(samples),
        others=tuple(joint.name for joint in joints if joint.motion is Motion.OTHER),
        welds={joint.child: joint.parent for joint in joints if joint.motion is Motion.FIXED},
    )


def _root(links: Sequence[EngineLink], joints: Sequence[EngineJoint]) -> str:
    children = {joint.child for joint in joints}
    grounded = any(joint.parent == WORLD for joint in joints)
    return WORLD if grounded else next((link.name for link in links if link.name not in children), WORLD)


def _sample(tree: _KinematicTree, back: Matrix, number: int) -> Sample:
    places = {joint.name: position(name, number) for name, joint in tree.moving.items()}
    shifts = {name: back @ tree.shift(name, places) for name in tree.links}
    poses = {name: shifts[name] @ link.pose for name, link in tree.links.items()}
    bodies = {
        name: moved(poses[name] @ link.center, link.mass, np.zeros(3), link.inertia)
        for name, link in tree.links.items()
        if link.mass > 0
    }
    matrix = np.zeros((len(tree.moving), len(tree.moving)))
    forces = np.zeros(len(tree.moving))
    for name, body in bodies.items():
        turning, sliding = _jacobian(tree, name, body.center, shifts)
        matrix += turning.T @ body.inertia @ turning + body.mass * sliding.T @ sliding
        forces -= body.mass * GRAVITY * sliding[2]
    gravity = {name: float(force) for name, force in zip(tree.moving, forces, strict=True)}
    return Sample(poses, bodies, matrix, gravity)


def _jacobian(tree: _KinematicTree, link: str, center: Matrix, shifts: Mapping[str, Matrix]) -> tuple[Matrix, Matrix]:
    """Return the rotational and translational Jacobians of a link's center of mass, a column for each moving joint."""
    turning, sliding = np.zeros((3, len(tree.moving))), np.zeros((3, len(tree.moving)))
    chain = tree.chain(link)
    for column, joint in enumerate(tree.moving.values()):
        if joint.name not in chain:
            continue
        # a joint's own motion does not move its axis, so the frame may be moved with the child
        frame = shifts[joint.child] @ joint.pose
        axis = frame[:3, :3] @ joint.axis
        turns = joint.motion is Motion.TURNS
        turning[:, column] = axis if turns else 0.0
        sliding[:, column] = np.cross(axis, center - frame[:3, 3]) if turns else axis
    return turning, sliding


def _motion(joint: EngineJoint, place: float) -> Matrix:
    motion = np.eye(4)
    if joint.motion is Motion.SLIDES:
        motion[:3, 3] = joint.axis * place
    elif joint.motion is Motion.TURNS:
        x, y, z = joint.axis
        skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        motion[:3, :3] += math.sin(place) * skew + (1 - math.cos(place)) * skew @ skew
    return motion
