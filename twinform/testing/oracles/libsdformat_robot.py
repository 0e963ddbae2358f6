"""Robots as libsdformat sees them, in one file or compared in two: it resolves frames, the kinematics are done here.

Two files are compared with fixed joints lumped, as the library's own reader of URDF does it, and with the place of each
model in the world; every shape is compared by its kind, its geometry and its place in the world.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from enum import Enum, auto
from pathlib import Path

import numpy as np

from twinform.dataclass import dataclass
from twinform.testing.oracles.libsdformat import JointRow, LinkRow, RobotRow, describe
from twinform.testing.oracles.robot import (
    GRAVITY,
    WORLD,
    EngineRobot,
    Matrix,
    Sample,
    View,
    inverse,
    limit,
    lumped,
    moved,
    pose,
    position,
)
from twinform.testing.oracles.robot_comparison import judge, renamed


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


_MOTIONS = {2: Motion.TURNS, 3: Motion.FIXED, 5: Motion.SLIDES, 6: Motion.TURNS}
"""The joint types with at most one degree of freedom, by the library's numbers."""
_CONTINUOUS = 2
_ENDLESS = {"lower": -math.inf, "upper": math.inf}
"""The limits of a continuous joint, whatever is written."""


def read(path: Path, view: View) -> EngineRobot:
    """Read the first model of a file.

    Raises:
        RuntimeError: libsdformat has errors for the file.
    """
    found = describe(path)
    links = [link_of(row) for row in found["links"]]
    joints = [joint_of(row) for row in found["joints"]]
    if found["static"]:
        joints += _fixed_roots(links, joints)
    seen = robot("libsdformat", links, joints, pose_matrix(found["pose"]), view)
    # it weighs links together itself when it reads URDF
    return lumped(seen) if path.suffix == ".urdf" else seen


def _fixed_roots(links: list[EngineLink], joints: list[EngineJoint]) -> list[EngineJoint]:
    """Return fixed joints that hold the roots of a static model in the world."""
    children = {joint.child for joint in joints}
    roots = (link for link in links if link.name not in children)
    return [EngineJoint(link.name, Motion.FIXED, WORLD, link.name, link.pose, np.zeros(3), {}) for link in roots]


def link_of(row: LinkRow) -> EngineLink:
    """Return a link in the frame of its model."""
    xx, yy, zz, xy, xz, yz = row["moments"]
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    return EngineLink(row["name"], pose_matrix(row["pose"]), row["mass"], pose_matrix(row["center"]), inertia)


def joint_of(row: JointRow) -> EngineJoint:
    """Return a joint in the frame of its model."""
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
    """Convert a position and a quaternion, real part first, into a 4 x 4 matrix."""
    w, *vector = numbers[3:]
    x, y, z = vector
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return pose(np.eye(3) + 2 * w * skew + 2 * skew @ skew, np.array(numbers[:3]))


TOLERANCE = 1e-6
"""In m, kg and so on: urdfdom and the library's writer keep fewer digits than the files have."""
_Shape = tuple[str, int, Matrix]


def differences(before: Sequence[RobotRow], after: Sequence[RobotRow]) -> Iterator[str]:
    """Yield the differences between the models of two files as text; models are matched by name."""
    there = {row["name"]: row for row in after}
    for row in before:
        other = there.pop(row["name"], None)
        if other is None:
            yield f"model {row['name']!r} is missing"
            continue
        yield from (f"model {row['name']!r}: {what}" for what in _of_model(row, other))
    yield from (f"model {name!r} is new" for name in there)


def _of_model(before: RobotRow, after: RobotRow) -> Iterator[str]:
    if before["static"] != after["static"]:
        yield f"static {before['static']} became {after['static']}"
    first, second = _held_robot(before, View()), _held_robot(after, View())
    if names := renamed(first, second):
        second = _held_robot(after, View(names))
    if _grounded(before) != _grounded(after):
        yield "other links are fixed to the world"
    if cause := judge(first, second, tolerance=TOLERANCE, lumped=True).cause:
        yield cause
    yield from _of_shapes(before, after)
    for kind, one, other in (
        ("sensors", sorted(map(_sensor, before["sensors"])), sorted(map(_sensor, after["sensors"]))),
        ("plugins", len(before["plugins"]), len(after["plugins"])),
    ):
        if one != other:
            yield f"{kind} {one} became {other}"


def _sensor(row: object) -> str:
    assert isinstance(row, dict)
    return f"{row['kind']} {row['name']}"


def _held_robot(row: RobotRow, view: View) -> EngineRobot:
    """Return the model with its roots held at their place in the world, whether they are fixed to it or not."""
    links, joints = [link_of(each) for each in row["links"]], [joint_of(each) for each in row["joints"]]
    loose = _tree([joint for joint in joints if joint.parent != WORLD or joint.motion is not Motion.FIXED])
    children = {joint.child for joint in loose}
    roots = (link for link in links if link.name not in children)
    held = [
        EngineJoint(f"{WORLD} {link.name}", Motion.OTHER, WORLD, link.name, link.pose, np.zeros(3), {})
        for link in roots
    ]
    return robot("libsdformat", links, [*loose, *held], pose_matrix(row["pose"]), view)


def _tree(joints: Sequence[EngineJoint]) -> list[EngineJoint]:
    """Return the joints without those that close a loop."""
    above: dict[str, EngineJoint] = {}
    for joint in joints:
        name = joint.parent
        while name in above and name != joint.child:
            name = above[name].parent
        if joint.child not in above and name != joint.child:
            above[joint.child] = joint
    return list(above.values())


def _grounded(row: RobotRow) -> set[str]:
    """Return the links that are fixed to the world by a joint; none for a static model."""
    fixed = (joint_of(each) for each in row["joints"] if not row["static"])
    return {joint.child for joint in fixed if joint.parent == WORLD and joint.motion is Motion.FIXED}


def _of_shapes(before: RobotRow, after: RobotRow) -> Iterator[str]:
    rest = list(_shapes(after))
    for kind, geometry, place in _shapes(before):
        found = next((n for n, one in enumerate(rest) if one[:2] == (kind, geometry) and _near(one[2], place)), None)
        if found is None:
            x, y, z = place[:3, 3]
            yield f"no {kind} of geometry {geometry} is at {x:.4g} {y:.4g} {z:.4g}"
            return
        del rest[found]
    if rest:
        yield f"{len(rest)} shapes are new"


def _near(one: Matrix, other: Matrix) -> bool:
    """Whether two poses are the same."""
    # urdfdom turns what points straight up or down by up to 0.005 rad
    far = max(1.0, float(np.abs(one[:3, 3]).max()))
    moved, turned = np.abs(one - other)[:3, 3].max(), np.abs(one - other)[:3, :3].max()
    return bool(moved <= TOLERANCE * far and turned <= 5e-3)


def _shapes(row: RobotRow) -> Iterator[_Shape]:
    model = pose_matrix(row["pose"])
    for link in row["links"]:
        for shape in link["shapes"]:
            place = model @ pose_matrix(link["pose"]) @ pose_matrix(shape["place"])
            yield shape["kind"], shape["geometry"], place
