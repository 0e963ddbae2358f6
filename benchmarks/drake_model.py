"""A model as Drake sees it, nested models included, in the form that the oracle scripts compare."""

import importlib
import logging
import math
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Matrix = npt.NDArray[np.float64]
Samples = Mapping[str, Any]
"""A model as an oracle script describes it: names, and poses, masses and matrices at some joint positions."""
Position = Callable[[str, int], float]
"""Where the joint of a name stands in the sample of a number."""
Parts = dict[str, Any]
"""Drake's bodies or joints by name."""

WORLD = "world"
_GRAVITY = np.array([0.0, 0.0, -9.81])
_UNLIMITED = 1e15
"""SDF up to 1.9 has 1e16 where there is no limit."""
_FREE = 6


def read(path: Path, *, names: Mapping[str, str], reference: str | None, position: Position, count: int) -> Samples:
    """The first model of a file at `count` sets of joint positions, its joints called by other `names` where given.

    Poses and gravity are relative to the link `reference`; where the model does not have it, to the world if something
    is joined to that, else to its first root.

    Raises:
        Exception: Drake cannot read it; it has no narrower type for that.
    """
    logging.getLogger("drake").setLevel(logging.CRITICAL)
    plant = importlib.import_module("pydrake.multibody.plant").MultibodyPlant(0.0)  # no scene graph, so no meshes
    parser = importlib.import_module("pydrake.multibody.parsing").Parser(plant)
    prefix = f"{plant.GetModelInstanceName(parser.AddModels(str(path))[0])}::"
    plant.Finalize()
    index = importlib.import_module("pydrake.multibody.tree").BodyIndex
    bodies = _named(plant, (plant.get_body(index(number)) for number in range(plant.num_bodies())), prefix)
    joints = _named(plant, (plant.get_joint(number) for number in plant.GetJointIndices()), prefix)
    moving = {names.get(name, name): joint for name, joint in joints.items() if joint.num_velocities() == 1}
    reference = reference if reference in bodies else _reference(bodies, joints)
    origin = _pose(plant, plant.CreateDefaultContext(), bodies[reference]) if reference != WORLD else np.eye(4)
    plant.mutable_gravity_field().set_gravity_vector(origin[:3, :3] @ _GRAVITY)
    return {
        "reference": reference,
        "dofs": list(moving),
        "links": list(bodies),
        "limits": {name: _limits(joint) for name, joint in moving.items()},
        "samples": [_sample(plant, bodies, moving, origin, lambda name, k=k: position(name, k)) for k in range(count)],
    }


def _named(plant: Any, parts: Iterable[Any], prefix: str) -> Parts:
    """Those of the model and the models in it, by their names inside it."""
    scoped = ((f"{plant.GetModelInstanceName(part.model_instance())}::{part.name()}", part) for part in parts)
    return {name.removeprefix(prefix): part for name, part in scoped if name.startswith(prefix)}


def _reference(bodies: Parts, joints: Parts) -> str:
    grounded = any(joint.parent_body().name() == WORLD and joint.num_velocities() < _FREE for joint in joints.values())
    if grounded:
        return WORLD
    # nested models come first in Drake's order; the outer one has the root that a tree hangs from
    return min(
        (name for name, body in bodies.items() if body.is_floating_base_body()), key=lambda name: name.count("::")
    )


def _limits(joint: Any) -> dict[str, float]:
    limits = {
        "lower": float(joint.position_lower_limits()[0]),
        "upper": float(joint.position_upper_limits()[0]),
        "velocity": float(joint.velocity_upper_limits()[0]),
    }
    known = {key: math.copysign(math.inf, value) if abs(value) > _UNLIMITED else value for key, value in limits.items()}
    return known | {"damping": float(joint.default_damping_vector()[0])}


def _sample(plant: Any, bodies: Parts, joints: Parts, origin: Matrix, position: Callable[[str], float]) -> Samples:
    context = plant.CreateDefaultContext()
    positions = plant.GetPositions(context)
    for name, joint in joints.items():
        positions[joint.position_start()] = position(name)
    plant.SetPositions(context, positions)
    speeds = [joint.velocity_start() for joint in joints.values()]
    forces = plant.CalcGravityGeneralizedForces(context)
    sample: dict[str, Any] = {"X": {}, "mass": {}, "com": {}, "I": {}}
    sample["M"] = plant.CalcMassMatrix(context)[np.ix_(speeds, speeds)]
    sample["g"] = {name: float(forces[speed]) for name, speed in zip(joints, speeds, strict=True)}
    for name, body in bodies.items():
        pose = np.linalg.inv(origin) @ _pose(plant, context, body)
        inertia = body.CalcSpatialInertiaInBodyFrame(context)
        sample["X"][name], sample["mass"][name] = pose, inertia.get_mass()
        if inertia.get_mass() > 0:
            sample["com"][name] = (pose @ [*inertia.get_com(), 1])[:3]
            moments = inertia.Shift(inertia.get_com()).CalcRotationalInertia().CopyToFullMatrix3()
            sample["I"][name] = pose[:3, :3] @ moments @ pose[:3, :3].T
    return sample


def _pose(plant: Any, context: Any, body: Any) -> Matrix:
    return plant.EvalBodyPoseInWorld(context, body).GetAsMatrix4()
