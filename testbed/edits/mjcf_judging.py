"""Judges edited MJCF: MuJoCo, which ignores carriers, reads the file, and what its result becomes again."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from importlib import import_module
from typing import Any
from zlib import crc32

from twinform.compiler import CompileError, convert

# Neither of them has types that a checker knows in full.
mujoco: Any = import_module("mujoco")
np: Any = import_module("numpy")
_TOLERANCE = 1e-6
_DIGITS = 5
_MASSLESS = 1e-9
"""Bodies that weigh less have the token of a link without mass."""


@dataclass(frozen=True, slots=True)
class MjcfVerdict:
    """What became of an edited file: `same`, `refused` by us, `unreadable` for MuJoCo, or `wrong`, with the reason."""

    outcome: str
    reason: str = ""


def judge_mjcf(edited: bytes, to: str) -> MjcfVerdict:
    """Convert an edited file to URDF or SDF and that to MJCF again, and compare both files of MJCF in MuJoCo."""
    try:
        before = mujoco.MjModel.from_xml_string(edited.decode())
    except ValueError as error:
        return MjcfVerdict("unreadable", str(error))
    try:
        made = convert(edited, to="urdf" if to == "urdf" else "sdf").text
    except CompileError as error:
        return _refused(error)
    try:
        after = mujoco.MjModel.from_xml_string(convert(made.encode(), to="mjcf").text)
    except CompileError as error:
        return _refused(error)
    except ValueError as error:
        return MjcfVerdict("wrong", f"MuJoCo refuses the result: {error}")
    found = next(_differences(before, after), None)
    return MjcfVerdict("same") if found is None else MjcfVerdict("wrong", found)


def _refused(error: CompileError) -> MjcfVerdict:
    errors = [each for each in error.diagnostics if each.is_error]
    reason = "; ".join(f"{each.rule.name}: {each.message}" for each in errors)[:300]
    return MjcfVerdict("refused", reason)


def _differences(one: Any, other: Any) -> Iterator[str]:
    """Yield how the robots of two models differ: joints, masses, and places at some positions of the joints."""
    joints, others = _joints(one), _joints(other)
    if joints.keys() != others.keys():
        yield f"joints {sorted(joints.keys() ^ others.keys())}"
        return
    for name, values in joints.items():
        if not np.allclose(values, others[name], rtol=_TOLERANCE, atol=3e-9):
            yield f"joint {name}: {values} and {others[name]}"
    for seed in (0, 1):
        mine, theirs = _bodies(one, seed), _bodies(other, seed)
        if mine.keys() != theirs.keys():
            yield f"bodies {sorted(mine.keys() ^ theirs.keys())}"
            return
        for name, values in mine.items():
            if not np.allclose(values, theirs[name], rtol=_TOLERANCE, atol=_TOLERANCE):
                yield f"body {name}: {values} and {theirs[name]}"
        yield from _compare_geoms(one, other, seed)


def _compare_geoms(one: Any, other: Any, seed: int) -> Iterator[str]:
    mine, theirs = _geoms(one, seed), _geoms(other, seed)
    if len(mine) != len(theirs):
        yield f"{len(mine)} and {len(theirs)} geoms"
        return
    left = list(theirs)
    for each in mine:
        found = next((at for at, them in enumerate(left) if np.allclose(each, them, rtol=1e-5, atol=1e-5)), None)
        if found is None:
            yield f"geom {each}"
            return
        left.pop(found)


def _joints(model: Any) -> dict[str, list[float]]:
    found: dict[str, list[float]] = {}
    for index in range(model.njnt):
        joint = model.joint(index)
        limits = [*joint.range] if joint.limited[0] else [-math.inf, math.inf]
        numbers = [float(joint.type[0]), *limits, float(joint.stiffness.flat[0])]
        dof = model.jnt_dofadr[index]
        damping = np.asarray(model.dof_damping).reshape(model.nv, -1)[dof][0] if joint.type[0] else 0.0
        name = joint.name if joint.type[0] else f"free {model.body(joint.bodyid[0]).name}"
        found[name] = [*numbers, float(damping), float(model.dof_frictionloss[dof])]
    return found


def _data(model: Any, seed: int) -> Any:
    data = mujoco.MjData(model)
    for index in range(model.njnt):
        joint = model.joint(index)
        if seed and joint.type[0] in {2, 3}:
            data.qpos[joint.qposadr[0]] = (crc32(joint.name.encode()) % 1000) / 1000 - 0.5
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    return data


def _bodies(model: Any, seed: int) -> dict[str, Any]:
    data = _data(model, seed)
    found: dict[str, Any] = {}
    for index in range(1, model.nbody):
        mass = float(model.body_mass[index])
        if mass > _MASSLESS:
            turn = data.ximat[index].reshape(3, 3)
            inertia = turn @ np.diag(model.body_inertia[index]) @ turn.T
            found[model.body(index).name] = np.array([mass, *data.xipos[index], *inertia.flat])
    return found


def _geoms(model: Any, seed: int) -> list[Any]:
    data = _data(model, seed)
    found: list[Any] = []
    for index in range(model.ngeom):
        seen = not (model.geom_contype[index] or model.geom_conaffinity[index])
        turn = data.geom_xmat[index].reshape(3, 3) if model.geom_type[index] != mujoco.mjtGeom.mjGEOM_SPHERE else None
        axis = (0.0, 0.0, 0.0) if turn is None else np.abs(turn[:, 2])
        size = [float(each) for each in model.geom_size[index]]
        look = model.geom_rgba[index] if seen else (0, 0, 0, 0)
        slides = 0.0 if seen else model.geom_friction[index][0]
        numbers = [seen, model.geom_type[index], *size, *data.geom_xpos[index], *axis, *look, slides]
        found.append(np.array(numbers, dtype=float).round(_DIGITS))
    return found
