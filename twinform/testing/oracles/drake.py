"""Models as Drake reads them, URDF or SDF, nested models included."""

import importlib
import logging
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np

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
)

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
