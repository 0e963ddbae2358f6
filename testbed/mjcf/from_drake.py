"""A model of SDF as Drake reads it, against our MJCF of it as MuJoCo reads that: frames, masses, forces and limits.

The two count freedoms differently: a free body turns about axes of the world in Drake and about its own in MuJoCo, and
a screw is one joint there and two here. A matrix takes the velocities of Drake to those of MuJoCo.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from testbed.mjcf.compiled import Array, Compiled
from testbed.mjcf.differences import POSES, TOLERANCE, compare, speeds
from twinform.ir.defaults import UNLIMITED
from twinform.testing.oracles import drake

LOOSE = 1e-6
"""Drake computes bias forces from spatial velocities, with larger sums."""
_GRAVITY = (0.0, 0.0, -9.81)


class UncomparableError(Exception):
    """A model has a joint that is not compared; the message names it."""


def differences_from_drake(
    path: Path, made: Compiled, seed: int = 1, gravity: tuple[float, ...] = _GRAVITY
) -> list[str]:
    """Return a line for each difference; none where both programs see one robot, in this gravity.

    Raises:
        Exception: Drake cannot read the file; it has no narrower type for that.
    """
    plant, bodies, joints, _ = drake.parts(path)
    plant.mutable_gravity_field().set_gravity_vector(np.array(gravity))
    match = _Match(plant, bodies, joints, made)
    if found := list(match.unmatched()):
        return found
    return [*match.limits(), *match.motions(np.random.default_rng(seed))]


class _Match:
    """The freedoms of a model in both programs."""

    def __init__(self, plant: Any, bodies: drake.Parts, joints: drake.Parts, made: Compiled) -> None:
        self.plant, self.bodies, self.made = plant, bodies, made
        self.joints = {
            self._name_in_ours(name, joint): joint for name, joint in joints.items() if joint.num_velocities()
        }

    def _name_in_ours(self, name: str, joint: Any) -> str:
        """The name that a joint has in the file: Drake puts it into the model of its child, however deep that is."""
        scopes = name.split("::")
        for count in range(len(scopes) - 1, -1, -1):
            found = "::".join([*scopes[:count], scopes[-1]])
            if set(self._names(found, joint)) <= self.made.joints.keys():
                return found
        return name

    def unmatched(self) -> Iterator[str]:
        """Yield what only one of them has."""
        known = {each for name, joint in self.joints.items() for each in self._names(name, joint)}
        theirs = set(self.made.joints)
        yield from (f"joint {name!r} is missing" for name in sorted(known - theirs))
        yield from (f"joint {name!r} is new" for name in sorted(theirs - known))
        ours = {self.made.model.body(number).name for number in range(self.made.model.nbody)}
        yield from (f"link {name!r} is missing" for name in sorted(set(self.bodies) - ours))

    def _names(self, name: str, joint: Any) -> tuple[str, ...]:
        """What the joints of MuJoCo are called that stand for one of Drake."""
        match joint.type_name():
            case "revolute" | "prismatic" | "ball_rpy":
                return (name,)
            case "universal":
                return (f"{name}_axis", name)
            case "screw":
                return (f"{name}_slide", name)
            case "quaternion_floating":
                body = joint.child_body()
                return tuple(known for known, each in self.bodies.items() if each.index() == body.index())
            case other:
                raise UncomparableError(f"joint {name!r} is {other}")

    def limits(self) -> Iterator[str]:
        """Yield the limits and dampings that differ."""
        for name, joint in self.joints.items():
            if joint.type_name() not in {"revolute", "prismatic"}:
                continue
            facts = self.made.facts(self.made.joints[name])
            ends = tuple(
                _end(float(each[0])) for each in (joint.position_lower_limits(), joint.position_upper_limits())
            )
            range_ = facts.range or (-math.inf, math.inf)
            if not np.allclose(ends, range_, rtol=TOLERANCE, atol=2 * TOLERANCE):
                yield f"range of joint {name!r}: {ends} is {range_}"
            if not math.isclose(float(joint.default_damping_vector()[0]), facts.damping, abs_tol=TOLERANCE):
                yield f"damping of joint {name!r}: {joint.default_damping_vector()[0]} is {facts.damping}"

    def motions(self, draw: np.random.Generator) -> list[str]:
        """The first difference of each kind at random positions."""
        found: dict[str, str] = {}
        plant, made = self.plant, self.made
        context = plant.CreateDefaultContext()
        for _ in range(POSES):
            there = made.model.qpos0.copy()
            for name, joint in self.joints.items():
                self._draw(context, name, joint, there, draw)
            speed = speeds(draw, plant.num_velocities())
            plant.SetVelocities(context, speed)
            turn = self._velocities(context)
            other = made.at(there, turn @ speed)
            bias = plant.CalcBiasTerm(context) - plant.CalcGravityGeneralizedForces(context)
            compare(found, "the mass matrix", plant.CalcMassMatrix(context), turn.T @ other.mass @ turn, LOOSE)
            compare(found, "the bias forces", bias, turn.T @ other.bias, LOOSE)
            for name, body in self.bodies.items():
                pose = plant.EvalBodyPoseInWorld(context, body).GetAsMatrix4()
                compare(found, f"the pose of link {name!r}", pose, other.bodies[name])
        return list(found.values())

    def _draw(self, context: Any, name: str, joint: Any, there: Array, draw: np.random.Generator) -> None:
        plant, model = self.plant, self.made.model
        addresses = [int(model.jnt_qposadr[self.made.joints[each]]) for each in self._names(name, joint)]
        positions = plant.GetPositions(context)
        start = joint.position_start()
        match joint.type_name():
            case "quaternion_floating":
                turn = draw.normal(size=4)
                turn /= np.linalg.norm(turn)
                place = draw.uniform(-1.0, 1.0, 3)
                positions[start : start + 7] = [*turn, *place]
                there[addresses[0] : addresses[0] + 7] = [*place, *turn]
            case "ball_rpy":
                positions[start : start + 3] = draw.uniform(-1.0, 1.0, 3)
            case "screw":
                positions[start] = angle = draw.uniform(-math.pi, math.pi)
                there[addresses] = [joint.screw_pitch() * angle / math.tau, angle]
            case _:
                count = joint.num_positions()
                positions[start : start + count] = there[addresses] = draw.uniform(-math.pi, math.pi, count)
        plant.SetPositions(context, positions)
        if joint.type_name() == "ball_rpy":
            there[addresses[0] : addresses[0] + 4] = quaternion_of(self._ball_turn(context, joint))

    def _ball_turn(self, context: Any, joint: Any) -> Array:
        """How far the child of a ball joint is turned from where it is drawn, in its own axes."""
        child = joint.frame_on_child().CalcPoseInBodyFrame(context).rotation().matrix()
        moved = joint.frame_on_child().CalcPose(context, joint.frame_on_parent()).rotation().matrix()
        return child @ moved @ child.T

    def _velocities(self, context: Any) -> Array:
        """The matrix from the velocities of Drake to those of MuJoCo."""
        model = self.made.model
        matrix = np.zeros((model.nv, self.plant.num_velocities()))
        for name, joint in self.joints.items():
            rows = [int(model.jnt_dofadr[self.made.joints[each]]) for each in self._names(name, joint)]
            start = joint.velocity_start()
            match joint.type_name():
                case "quaternion_floating":
                    body = joint.child_body()
                    turn = self.plant.EvalBodyPoseInWorld(context, body).rotation().matrix()
                    matrix[rows[0] : rows[0] + 3, start + 3 : start + 6] = np.eye(3)
                    matrix[rows[0] + 3 : rows[0] + 6, start : start + 3] = turn.T
                case "ball_rpy":
                    child = joint.frame_on_child().CalcPoseInBodyFrame(context).rotation().matrix()
                    moved = joint.frame_on_child().CalcPose(context, joint.frame_on_parent()).rotation().matrix()
                    matrix[rows[0] : rows[0] + 3, start : start + 3] = child @ moved.T
                case "screw":
                    matrix[rows, start] = [joint.screw_pitch() / math.tau, 1.0]
                case _:
                    for number, row in enumerate(rows):
                        matrix[row, start + number] = 1.0
        return matrix


def quaternion_of(turn: Array) -> Array:
    """A rotation as a quaternion w x y z."""
    values, vectors = np.linalg.eigh(_symmetric(turn))
    return vectors[:, int(np.argmax(values))]


def _symmetric(turn: Array) -> Array:
    """The matrix whose greatest eigenvector is the quaternion of a rotation (Bar-Itzhack)."""
    (a, b, c), (d, e, f), (g, h, i) = turn
    return (
        np.array(
            [
                [a + e + i, h - f, c - g, d - b],
                [h - f, a - e - i, b + d, c + g],
                [c - g, b + d, e - a - i, f + h],
                [d - b, c + g, f + h, i - a - e],
            ]
        )
        / 3
    )


def _end(value: Any) -> float:
    """An end of a range; what SDF writes for infinity is that."""
    return math.copysign(math.inf, value) if abs(value) >= UNLIMITED else float(value)
