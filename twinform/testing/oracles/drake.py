"""Models as Drake reads them, URDF or SDF, nested models included; and two of them let go: do they move alike?

Gravity acts, motors and contacts do not. Joints and free links start away from zero, and moving. Joints that mimic
others move freely, since Drake does not read `<mimic>` in SDF; friction and limits of joints do not act, since Drake
has none in continuous time.
"""

import importlib
import logging
import math
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from twinform.dataclass import dataclass
from twinform.testing.oracles.engines import Alike, EngineUnreadableError, Verdict
from twinform.testing.oracles.robot import (
    GRAVITY,
    WORLD,
    EngineBody,
    EngineRobot,
    Matrix,
    Sample,
    View,
    inverse,
    limit,
    moved,
    position,
    spread,
)
from twinform.testing.oracles.robot_comparison import IN_CHAINS, chained, read_robot, renamed

Parts = dict[str, Any]
"""Drake's bodies or joints by name."""

_FREE = 6
_OF_JOINTS = ("_parent", "_child", "_F", "_M")


def read(path: Path, view: View) -> EngineRobot:
    """Read the first model of a file.

    Raises:
        Exception: Drake cannot read it; it has no narrower type for that.
    """
    plant, bodies, joints, frames = parts(path)
    moving = view.moving((name, joint) for name, joint in joints.items() if is_simple(joint))
    reference = view.reference if view.reference in bodies else root(bodies, joints)
    origin = _pose(plant, plant.CreateDefaultContext(), bodies[reference]) if reference != WORLD else np.eye(4)
    # Gravity along the axes of the reference link, since a conversion may place the model's frame
    # elsewhere.
    plant.mutable_gravity_field().set_gravity_vector(origin[:3, :3] @ np.array([0.0, 0.0, -GRAVITY]))
    samples = (
        _sample(plant, bodies, moving, frames, origin, lambda name, number=number: position(name, number))
        for number in range(view.count)
    )
    return EngineRobot(
        engine="drake",
        reference=reference,
        joints=tuple(moving),
        links=tuple(bodies),
        limits={name: _limits(joint) for name, joint in moving.items()},
        samples=tuple(samples),
        welds=_welds(bodies, joints),
        others=tuple(
            view.names.get(name, name)
            for name, joint in joints.items()
            if joint.num_velocities() and not is_simple(joint)
        ),
    )


def is_simple(joint: Any) -> bool:
    """Whether a joint turns or slides along one axis."""
    return joint.num_velocities() == 1 and joint.type_name() in {"revolute", "prismatic"}


def parts(path: Path) -> tuple[Any, Parts, Parts, Parts]:
    """Return the plant of the first model of a file, its bodies, joints and frames; no shapes, so no mesh is missed.

    Joints that mimic others move freely.
    """
    logging.getLogger("drake").setLevel(logging.CRITICAL)
    plant = importlib.import_module("pydrake.multibody.plant").MultibodyPlant(0.0)
    parser = importlib.import_module("pydrake.multibody.parsing").Parser(plant)
    prefix = f"{plant.GetModelInstanceName(parser.AddModels(str(path))[0])}::"
    # Drake 1.51 reads <mimic> in URDF and, in SDF, only its own drake:mimic: coupled joints would
    # move apart for that reason alone. Whether a mimic is the same is a question for `twinform
    # diff`.
    for constraint in plant.GetConstraintIds():
        plant.RemoveConstraint(constraint)
    plant.Finalize()
    tree = importlib.import_module("pydrake.multibody.tree")
    bodies = _parts_by_name(
        plant, (plant.get_body(tree.BodyIndex(number)) for number in range(plant.num_bodies())), prefix
    )
    joints = _parts_by_name(plant, (plant.get_joint(number) for number in plant.GetJointIndices()), prefix)
    every = _parts_by_name(
        plant, (plant.get_frame(tree.FrameIndex(number)) for number in range(plant.num_frames())), prefix
    )
    frames = {name: frame for name, frame in every.items() if name not in bodies and not _is_of_joint(name, joints)}
    return plant, bodies, joints, frames


def _is_of_joint(name: str, joints: Parts) -> bool:
    """Whether Drake made a frame for a joint, such as `JOINT_parent` or `JOINT_JOINT_parent_F`."""
    return name.endswith(_OF_JOINTS) and any(name.startswith(f"{joint}_") for joint in joints)


def root(bodies: Parts, joints: Parts) -> str:
    """Return the world if something is joined to it, else the link that a tree hangs from."""
    if any(joint.parent_body().name() == WORLD and joint.num_velocities() < _FREE for joint in joints.values()):
        return WORLD
    # nested models come first in Drake's order; the outer one has the root that a tree hangs from
    free = (name for name, body in bodies.items() if body.is_floating_base_body())
    return min(free, key=lambda name: name.count("::"), default=WORLD)


def _parts_by_name(plant: Any, found: Iterable[Any], prefix: str) -> Parts:
    """Return the parts of a model and of its nested models, by their names relative to the model."""
    scoped = ((f"{plant.GetModelInstanceName(part.model_instance())}::{part.name()}", part) for part in found)
    return {name.removeprefix(prefix): part for name, part in scoped if name.startswith(prefix)}


def _welds(bodies: Parts, joints: Parts) -> dict[str, str]:
    names = {body.index(): name for name, body in bodies.items()}
    welds = (joint for joint in joints.values() if joint.num_velocities() == 0)
    return {
        names[joint.child_body().index()]: names.get(joint.parent_body().index(), WORLD)
        for joint in welds
        if joint.child_body().index() in names
    }


def _limits(joint: Any) -> dict[str, float]:
    return {
        "lower": limit(joint.position_lower_limits()[0]),
        "upper": limit(joint.position_upper_limits()[0]),
        "velocity": limit(joint.velocity_upper_limits()[0]),
        "damping": float(joint.default_damping_vector()[0]),
    }


def _sample(
    plant: Any, bodies: Parts, joints: Parts, frames: Parts, origin: Matrix, place: Callable[[str], float]
) -> Sample:
    context = plant.CreateDefaultContext()
    positions = plant.GetPositions(context)
    for name, joint in joints.items():
        positions[joint.position_start()] = place(name)
    plant.SetPositions(context, positions)
    speeds = [joint.velocity_start() for joint in joints.values()]
    forces = plant.CalcGravityGeneralizedForces(context)
    back = inverse(origin)
    poses = {name: back @ _pose(plant, context, body) for name, body in bodies.items()}
    weighed = ((name, _body(context, body, poses[name])) for name, body in bodies.items())
    return Sample(
        poses=poses,
        bodies={name: body for name, body in weighed if body is not None},
        mass_matrix=plant.CalcMassMatrix(context)[np.ix_(speeds, speeds)],
        gravity={name: float(forces[speed]) for name, speed in zip(joints, speeds, strict=True)},
        frames={name: back @ frame.CalcPoseInWorld(context).GetAsMatrix4() for name, frame in frames.items()},
    )


def _body(context: Any, body: Any, pose: Matrix) -> EngineBody | None:
    inertia = body.CalcSpatialInertiaInBodyFrame(context)
    if not inertia.get_mass() > 0:
        return None
    center = inertia.get_com()
    moments = inertia.Shift(center).CalcRotationalInertia().CopyToFullMatrix3()
    return moved(pose, inertia.get_mass(), center, moments)


def _pose(plant: Any, context: Any, body: Any) -> Matrix:
    return plant.EvalBodyPoseInWorld(context, body).GetAsMatrix4()


TOLERANCE = 1e-6
_ACCURACY = 1e-10
_LARGEST_STEP = 0.01
_TIMES = 10
_SWING = 0.5


@dataclass(frozen=True, slots=True)
class Trajectory:
    """The positions and velocities of each joint and free link, a row for each time."""

    states: Mapping[str, Matrix]


def moved_alike(first: Path, second: Path, seconds: float) -> Verdict:
    """Simulate two files and compare how they move.

    Raises:
        EngineUnreadableError: Drake cannot read or simulate one of them.
    """
    one, other = read_robot(first, "drake"), read_robot(second, "drake")
    here, there = chained(other, one), chained(one, other)
    before = _trajectory(first, View(still=here), seconds)
    after = _trajectory(second, View(renamed(one, other), still=there), seconds)
    if cause := _other_parts(before, after):
        return Verdict("drake", None, math.inf, "", cause)
    gaps = {name: _gap(before.states[name], after.states[name]) for name in before.states}
    worst = max(gaps, key=lambda name: gaps[name], default="")
    size = gaps.get(worst, 0.0)
    if size > (max(TOLERANCE, IN_CHAINS) if here or there else TOLERANCE):
        return Verdict("drake", None, size, worst, f"{worst} moves otherwise")
    return Verdict("drake", Alike.MOTION, size, worst)


def _gap(before: Matrix, after: Matrix) -> float:
    """Return the largest difference, relative to the largest number, at least one."""
    gap = float(np.abs(before - after).max()) / max(1.0, float(np.abs(before).max()))
    return math.inf if math.isnan(gap) else gap


def _other_parts(before: Trajectory, after: Trajectory) -> str:
    lost, added = before.states.keys() - after.states.keys(), after.states.keys() - before.states.keys()
    parts = [("only the first has", lost), ("only the second has", added)]
    return "; ".join(f"{what} {', '.join(sorted(names))}" for what, names in parts if names)


def _trajectory(path: Path, view: View, seconds: float) -> Trajectory:
    try:
        return _simulated(path, view, seconds)
    except (Exception, SystemExit) as error:
        raise EngineUnreadableError("drake", path, str(error)) from error


def _simulated(path: Path, view: View, seconds: float) -> Trajectory:
    plant, bodies, found, _ = parts(path)
    joints = view.moving((name, joint) for name, joint in found.items() if is_simple(joint))
    loose = {name: body for name, body in bodies.items() if body.is_floating_base_body()}
    analysis: Any = importlib.import_module("pydrake.systems.analysis")
    simulator = analysis.Simulator(plant)
    # An integrator of high order and accuracy, so that what is left is the difference of the two
    # models.
    analysis.ResetIntegratorFromFlags(simulator, "runge_kutta5", _LARGEST_STEP)
    simulator.get_mutable_integrator().set_target_accuracy(_ACCURACY)
    context = simulator.get_mutable_context()
    _start(plant, context, joints, loose)
    rows: list[Mapping[str, Matrix]] = []
    for number in range(_TIMES + 1):
        simulator.AdvanceTo(seconds * number / _TIMES)
        rows.append(_state(plant, context, joints, loose))
    return Trajectory({name: np.array([row[name] for row in rows]) for name in rows[0]})


def _start(plant: Any, context: Any, joints: Mapping[str, Any], loose: Mapping[str, Any]) -> None:
    for name, joint in joints.items():
        positions, speeds = plant.GetPositions(context), plant.GetVelocities(context)
        # By name and not by number: the order of joints is an engine's own business.
        positions[joint.position_start()] = _SWING * spread(f"{name}/position")
        speeds[joint.velocity_start()] = spread(f"{name}/velocity")
        plant.SetPositions(context, positions)
        plant.SetVelocities(context, speeds)
    maths: Any = importlib.import_module("pydrake.math")
    algebra: Any = importlib.import_module("pydrake.multibody.math")
    for name, body in loose.items():
        turn = maths.RollPitchYaw(*(spread(f"{name}/turn/{axis}") for axis in range(3)))
        place = np.array([spread(f"{name}/place/{axis}") for axis in range(3)])
        motion = np.array([spread(f"{name}/motion/{axis}") for axis in range(6)])
        plant.SetFreeBodyPose(context, body, maths.RigidTransform(turn, place))
        plant.SetFreeBodySpatialVelocity(body, algebra.SpatialVelocity(motion[:3], motion[3:]), context)


def _state(plant: Any, context: Any, joints: Mapping[str, Any], loose: Mapping[str, Any]) -> Mapping[str, Matrix]:
    positions, speeds = plant.GetPositions(context), plant.GetVelocities(context)
    state = {
        f"joint {name}": np.array([positions[joint.position_start()], speeds[joint.velocity_start()]])
        for name, joint in joints.items()
    }
    for name, body in loose.items():
        pose = plant.EvalBodyPoseInWorld(context, body).GetAsMatrix34()
        velocity = plant.EvalBodySpatialVelocityInWorld(context, body).get_coeffs()
        state[f"link {name}"] = np.concatenate([pose.ravel(), velocity])
    return state
