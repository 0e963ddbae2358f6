"""URDF models as Pinocchio reads them; it makes one body of links that are fixed to each other."""

import importlib
import math
from collections.abc import Mapping
from functools import partial
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

Joints = dict[str, Any]
"""Pinocchio's joints with one degree of freedom, by name."""


def read(path: Path, view: View) -> EngineRobot:
    """Read the robot of a file; its shapes are not loaded, so that no mesh is missed.

    Raises:
        Exception: Pinocchio cannot read it.
    """
    pinocchio: Any = importlib.import_module("pinocchio")
    model = pinocchio.buildModelFromUrdf(str(path))
    data = model.createData()
    links = {frame.name: frame for frame in model.frames if frame.type == pinocchio.FrameType.BODY}
    pinocchio.framesForwardKinematics(model, data, pinocchio.neutral(model))
    reference = view.reference if view.reference in {*links, WORLD} else next(iter(links))
    origin = np.eye(4) if reference == WORLD else _pose(model, data, links[reference])
    model.gravity.linear = origin[:3, :3] @ np.array([0.0, 0.0, -GRAVITY])
    joints = _joints(model, view)
    sample = partial(_sample, pinocchio, model, data, links, joints, inverse(origin))
    return EngineRobot(
        engine="pinocchio",
        reference=reference,
        joints=tuple(joints),
        links=tuple(name for name in links if name != WORLD),
        limits={name: _limits(model, joint) for name, joint in joints.items()},
        samples=tuple(sample(number) for number in range(view.count)),
        lumped=True,
    )


def _joints(model: Any, view: View) -> Joints:
    found = ((model.names[number], model.joints[number]) for number in range(1, model.njoints))
    return view.moving((name, joint) for name, joint in found if joint.nv == 1)


def _limits(model: Any, joint: Any) -> dict[str, float]:
    # Pinocchio keeps a continuous joint as a cosine and a sine, with limits of these
    turning = joint.nq > 1
    return {
        "lower": -math.inf if turning else limit(model.lowerPositionLimit[joint.idx_q]),
        "upper": math.inf if turning else limit(model.upperPositionLimit[joint.idx_q]),
        "velocity": limit(model.upperVelocityLimit[joint.idx_v]),
        "effort": limit(model.upperEffortLimit[joint.idx_v]),
        "damping": float(model.damping[joint.idx_v]),
        "friction": float(model.upperDryFrictionLimit[joint.idx_v]),
    }


def _sample(
    pinocchio: Any, model: Any, data: Any, links: Mapping[str, Any], joints: Joints, back: Matrix, sample: int
) -> Sample:
    positions = pinocchio.neutral(model)
    for name, joint in joints.items():
        place = position(name, sample)
        turn = [place] if joint.nq == 1 else [math.cos(place), math.sin(place)]
        positions[joint.idx_q : joint.idx_q + joint.nq] = turn
    upper = np.triu(pinocchio.crba(model, data, positions))
    speeds = [joint.idx_v for joint in joints.values()]
    forces = pinocchio.computeGeneralizedGravity(model, data, positions)
    pinocchio.framesForwardKinematics(model, data, positions)
    poses = {name: back @ _pose(model, data, frame) for name, frame in links.items()}
    return Sample(
        poses={name: found for name, found in poses.items() if name != WORLD},
        bodies=_bodies(model, links, back, data),
        mass_matrix=(upper + np.triu(upper, 1).T)[np.ix_(speeds, speeds)],
        gravity={name: -float(forces[speed]) for name, speed in zip(joints, speeds, strict=True)},
    )


def _bodies(model: Any, links: Mapping[str, Any], back: Matrix, data: Any) -> dict[str, EngineBody]:
    """Return the body of the root and of each joint, by the name of the first link in it."""
    first: dict[int, str] = {}
    for name, frame in links.items():
        first.setdefault(frame.parentJoint, name)
    weighed = {name: (model.inertias[number], data.oMi[number]) for number, name in first.items()}
    return {
        name: moved(back @ place.homogeneous, inertia.mass, inertia.lever, inertia.inertia)
        for name, (inertia, place) in weighed.items()
        if inertia.mass > 0
    }


def _pose(model: Any, data: Any, frame: Any) -> Matrix:
    return data.oMf[model.getFrameId(frame.name, frame.type)].homogeneous
