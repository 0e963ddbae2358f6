"""URDF models as MuJoCo reads them; it gets them without shapes, so that no mesh is missed."""

import contextlib
import importlib
import math
import tempfile
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
    pose,
    position,
    root_link,
    without_shapes,
)

Numbers = dict[str, int]
"""MuJoCo's numbers of bodies or joints by name."""


def read(path: Path, view: View) -> EngineRobot:
    """Read the robot of a file, with every link as a body of its own.

    Raises:
        Exception: MuJoCo cannot read it.
    """
    mujoco: Any = importlib.import_module("mujoco")
    text = without_shapes(path)
    model = _compiled(mujoco, text)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    bodies = {model.body(number).name: number for number in range(1, model.nbody)}
    joints = _joints(mujoco, model, view)
    root = root_link(text)
    reference = view.reference if view.reference in {*bodies, WORLD} else root
    origin = np.eye(4) if reference == WORLD else _pose(data, bodies[reference])
    model.opt.gravity[:] = origin[:3, :3] @ np.array([0.0, 0.0, -GRAVITY])
    sample = partial(_sample, mujoco, model, data, bodies, joints, inverse(origin))
    return EngineRobot(
        engine="mujoco",
        reference=reference,
        joints=tuple(joints),
        links=tuple(bodies),
        limits={name: _limits(model, number) for name, number in joints.items()},
        samples=tuple(sample(number) for number in range(view.count)),
        welds=_welds(model, bodies, root),
    )


def _compiled(mujoco: Any, text: bytes) -> Any:
    # it writes its warnings to a file in the working directory
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        spec = mujoco.MjSpec.from_string(text.decode())
        spec.compiler.fusestatic = False
        return spec.compile()


def _joints(mujoco: Any, model: Any, view: View) -> Numbers:
    moving = {int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_SLIDE)}
    numbers = (number for number in range(model.njnt) if int(model.jnt_type[number]) in moving)
    return view.moving((model.joint(number).name, number) for number in numbers)


def _welds(model: Any, bodies: Numbers, root: str) -> dict[str, str]:
    """Map links without a joint to the link that they are fixed to; the root, which only MuJoCo fixes, is left out."""
    fixed = {name: number for name, number in bodies.items() if model.body_jntnum[number] == 0 and name != root}
    return {name: model.body(int(model.body_parentid[number])).name for name, number in fixed.items()}


def _limits(model: Any, number: int) -> dict[str, float]:
    lower, upper = model.jnt_range[number] if model.jnt_limited[number] else (-math.inf, math.inf)
    effort = model.jnt_actfrcrange[number][1] if model.jnt_actfrclimited[number] else math.inf
    speed = int(model.jnt_dofadr[number])
    return {
        "lower": limit(lower),
        "upper": limit(upper),
        "effort": limit(effort),
        "damping": float(model.dof_damping[speed]),
        "friction": float(model.dof_frictionloss[speed]),
    }


def _sample(mujoco: Any, model: Any, data: Any, bodies: Numbers, joints: Numbers, back: Matrix, sample: int) -> Sample:
    for name, number in joints.items():
        data.qpos[model.jnt_qposadr[number]] = position(name, sample)
    mujoco.mj_forward(model, data)
    poses = {name: back @ _pose(data, number) for name, number in bodies.items()}
    speeds = [int(model.jnt_dofadr[number]) for number in joints.values()]
    return Sample(
        poses=poses,
        bodies={
            name: _body(model, data, number, back) for name, number in bodies.items() if model.body_mass[number] > 0
        },
        mass_matrix=_mass_matrix(mujoco, model, data)[np.ix_(speeds, speeds)],
        gravity={name: -float(data.qfrc_bias[speed]) for name, speed in zip(joints, speeds, strict=True)},
    )


def _mass_matrix(mujoco: Any, model: Any, data: Any) -> Matrix:
    matrix = np.zeros((model.nv, model.nv))
    for row, unit in zip(matrix, np.eye(model.nv), strict=True):
        mujoco.mj_mulM(model, data, row, unit)
    return matrix


def _body(model: Any, data: Any, number: int, back: Matrix) -> EngineBody:
    # MuJoCo has inertias along their own axes, with the center of mass as their origin
    inertial = back @ pose(data.ximat[number].reshape(3, 3), data.xipos[number])
    return moved(inertial, float(model.body_mass[number]), np.zeros(3), np.diag(model.body_inertia[number]))


def _pose(data: Any, number: int) -> Matrix:
    return pose(data.xmat[number].reshape(3, 3), data.xpos[number])
