"""Two models let go from the same state, in Drake: do they move alike?

Gravity acts, motors and contacts do not. Joints and free links start away from zero, and moving. Joints that mimic
others move freely, since Drake does not read `<mimic>` in SDF; friction and limits of joints do not act, since Drake
has none in continuous time.
"""

import importlib
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from twinform.dataclass import dataclass
from twinform.testing.oracles import drake
from twinform.testing.oracles.engines import Alike, EngineUnreadableError, Verdict
from twinform.testing.oracles.robot import Matrix, View, spread
from twinform.testing.oracles.robot_comparison import IN_CHAINS, chained, read_robot, renamed

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
    plant, bodies, found, _ = drake.parts(path)
    joints = view.moving((name, joint) for name, joint in found.items() if drake.is_simple(joint))
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
