"""Robots that fall and are driven for some seconds, in DART with SDF and in MuJoCo with our MJCF of it.

Both engines get the same steps of time, the same gravity, and the same forces on joints, which swing as a sine. MJCF
has no word for the greatest speed of a joint, so that DART gets none either, and DART knows no rotors, so that MuJoCo
gets none.
"""

import importlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree

import twinform
from testbed.engines.gazebo import Settings, Simulation, simulate
from testbed.engines.gazebo.differing import short
from testbed.engines.gazebo.joints import ENDLESS
from testbed.mjcf.compiled import Array, without_meshes

GRAVITY = 9.80665
"""What libsdformat has for a model without a world, m/s²."""
SECONDS = 2.0
STEP, FINE = 0.001, 0.00025
PERIOD = 1.0
"""Of the forces, in s."""
PUSH = 3.0
"""How fast each joint would be sped up by its greatest force alone, in rad/s² or m/s²."""
DROP = 0.05
"""How high above the ground the lowest collision is at the start, in m."""
_STIFF = (0.002, 1.0)
"""The `solref` of contacts that are ten times stiffer than usual: a time in s, and a share of the critical damping."""
_SPEED = (("limit", "velocity"),)
_CONSTRAINTS = (
    ("limit", "lower"), ("limit", "upper"), ("dynamics", "friction"),
    ("link", "gravity"), ("ode", "mu2"), ("ode", "fdir1"), ("ode", "slip1"), ("ode", "slip2"),
)  # fmt: skip
"""Elements with what holds them: ends of ranges, friction of joints, links without gravity, friction by direction."""
_NEAR = 1e-3
"""How near to a limit a joint has reached it, in rad or m."""
_HINGE_OR_SLIDE = (2, 3)
_PLANE = 0
Ends = Mapping[str, Array]
"""Where links are, in m, by name."""


class CannotBeDrivenError(Exception):
    """A robot has no joint that may be driven, or one of the engines does not take it; the message says which."""


@dataclass(frozen=True, slots=True)
class Driven:
    """How far apart the links of a robot are in the end, at most, in m.

    `apart` is between DART and MuJoCo, `dart` and `mujoco` what a fourth of the step changes in the one and in the
    other, `soft` what ten times stiffer contacts change in MuJoCo. `way` is how far a link went.
    """

    joints: int
    way: float
    apart: float
    dart: float
    mujoco: float
    soft: float
    reaches_limit: bool


@dataclass(frozen=True, slots=True)
class Setup:
    """A robot in both languages with what drives it; without a `ground` it falls freely, or hangs from the world."""

    sdf: Path
    mjcf: str
    forces: Mapping[str, float]
    ground: float | None
    folders: tuple[Path, ...]


def prepared(sdf: str, file: Path, paths: Sequence[Path] = (), *, on_ground: bool) -> Setup:
    """Write a robot into a file, convert it, and choose the forces on its joints.

    Raises:
        CannotBeDrivenError: nothing can be driven.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(_without(sdf.encode(), _SPEED))
    bare = Setup(file, etree.tostring(_mjcf(file, paths), encoding="unicode"), {}, None, tuple(paths))
    still = _in_dart(bare, STEP, 0)
    if not still.done:
        raise CannotBeDrivenError(f"DART: {still.outcome}")
    model, data = _compiled(bare, STEP)
    forces = {name: force for name, force in _forces(model, data).items() if _may_push(still, name, force)}
    if not forces:
        raise CannotBeDrivenError("no joint that moves")
    ground = _lowest(model, data) - DROP if on_ground else None
    if ground is not None and not np.isfinite(ground):
        raise CannotBeDrivenError("nothing can touch the ground")
    return replace(bare, forces=forces, ground=ground)


def without_constraints(setup: Setup, paths: Sequence[Path]) -> Setup:
    """The robot without limits and friction of joints, mimics, loops, and all that `_CONSTRAINTS` lists."""
    file = setup.sdf.with_suffix(".free.sdf")
    file.write_bytes(_without(setup.sdf.read_bytes(), _CONSTRAINTS))
    mjcf = _mjcf(file, paths)
    for section in mjcf.findall("equality"):
        mjcf.remove(section)
    return replace(setup, sdf=file, mjcf=etree.tostring(mjcf, encoding="unicode"))


def driven(setup: Setup, seconds: float = SECONDS) -> Driven:
    """Let a robot fall and drive it, in both engines.

    Raises:
        CannotBeDrivenError: an engine does not come to the end.
    """
    dart, finer = (_in_dart(setup, step, round(seconds / step)) for step in (STEP, FINE))
    if not dart.done or not finer.done:
        raise CannotBeDrivenError(f"DART: {dart.outcome}")
    ends = _ends(dart)
    start = {name: np.array(state.pose[:3]) for name, state in _links(dart, 0).items()}
    ours, ours_finer, ours_stiff = _in_mujoco(setup, STEP, seconds), _in_mujoco(setup, FINE, seconds), ends
    if setup.ground is not None:
        ours_stiff = _in_mujoco(setup, STEP, seconds, stiff=True)
    return Driven(
        len(setup.forces), apart(start, ends), apart(ends, ours), apart(ends, _ends(finer)), apart(ours, ours_finer),
        apart(ours, ours_stiff) if setup.ground is not None else 0.0, _reaches_limit(dart),
    )  # fmt: skip


def _mjcf(sdf: Path, paths: Sequence[Path]) -> Any:
    """The tree of our MJCF without meshes, and without the inertia of rotors, which DART does not read."""
    mjcf = etree.fromstring(without_meshes(twinform.convert(sdf, to="mjcf", paths=paths).text).encode())
    for joint in mjcf.iterfind(".//joint[@armature]"):
        del joint.attrib["armature"]
    return mjcf


def _without(text: bytes, parts: Iterable[tuple[str, str]]) -> bytes:
    """SDF without some elements, each with the one that it stands in."""
    root = etree.fromstring(text, etree.XMLParser(resolve_entities=False, no_network=True))
    for holder, name in parts:
        for each in root.findall(f".//{holder}/{name}"):
            around = each.getparent()
            if around is not None:
                around.remove(each)
    return etree.tostring(root)


def apart(one: Ends, other: Ends) -> float:
    """How far links of one name are apart at most."""
    return max((float(np.linalg.norm(one[name] - other[name])) for name in one if name in other), default=0.0)


def _in_dart(setup: Setup, step: float, steps: int) -> Simulation:
    settings = Settings(
        steps=steps, dt=step, every=round(0.02 / step), ground=setup.ground, forces=setup.forces, period=PERIOD,
        folders=setup.folders, seconds=60,
    )  # fmt: skip
    return simulate([setup.sdf], settings=settings)[setup.sdf.resolve()]


def _links(simulation: Simulation, moment: int) -> Mapping[str, Any]:
    links = simulation.moments[moment].links
    return {short(name): state for name, state in links.items() if name != "ground::ground"}


def _ends(simulation: Simulation) -> Ends:
    return {name: np.array(state.pose[:3]) for name, state in _links(simulation, -1).items()}


def _may_push(still: Simulation, name: str, force: float) -> bool:
    """Whether DART lets a joint be driven so hard."""
    inside = next((joint.inside for whole, joint in still.joint.items() if short(whole) == name), None)
    return inside is not None and len(inside.effort) == 1 and 0 < force <= inside.effort[0]


def _reaches_limit(simulation: Simulation) -> bool:
    """Whether a joint comes to one of its limits, or begins beyond one."""
    for name, joint in simulation.joint.items():
        if joint.inside is None or joint.freedom != 1:
            continue
        lower, upper = joint.inside.lower[0], joint.inside.upper[0]
        places = [moment.positions[name][0] for moment in simulation.moments]
        if (lower > -ENDLESS and min(places) < lower + _NEAR) or (upper < ENDLESS and max(places) > upper - _NEAR):
            return True
    return False


def _compiled(setup: Setup, step: float, *, stiff: bool = False) -> tuple[Any, Any]:
    """The model of MuJoCo with a ground, and its state, in which everything is where it is drawn."""
    mujoco: Any = importlib.import_module("mujoco")
    spec = mujoco.MjSpec.from_string(setup.mjcf)
    if setup.ground is not None:
        spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[50, 50, 1], pos=[0, 0, setup.ground])
    for geom in spec.geoms if stiff else ():
        geom.solref = _STIFF
    spec.option.timestep = step
    spec.option.gravity = [0.0, 0.0, -GRAVITY]
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def _forces(model: Any, data: Any) -> dict[str, float]:
    """The greatest force on each joint of one freedom: by what it would have to move alone, to three digits."""
    mujoco: Any = importlib.import_module("mujoco")
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    simple = [number for number in range(model.njnt) if model.jnt_type[number] in _HINGE_OR_SLIDE]
    dofs = {model.joint(number).name: int(model.jnt_dofadr[number]) for number in simple}
    return {name: float(f"{PUSH * mass[dof, dof]:.3g}") for name, dof in dofs.items()}


def _lowest(model: Any, data: Any) -> float:
    """The height of the lowest point of what touches anything; infinity where nothing does."""
    heights = [np.inf]
    for number in range(model.ngeom):
        touches = model.geom_contype[number] or model.geom_conaffinity[number]
        if touches and model.geom_type[number] != _PLANE:
            turn = data.geom_xmat[number].reshape(3, 3)
            middle, half = model.geom_aabb[number][:3], model.geom_aabb[number][3:]
            heights.append((data.geom_xpos[number] + turn @ middle)[2] - np.abs(turn[2]) @ half)
    return float(min(heights))


def _in_mujoco(setup: Setup, step: float, seconds: float, *, stiff: bool = False) -> Ends:
    mujoco: Any = importlib.import_module("mujoco")
    model, data = _compiled(setup, step, stiff=stiff)
    forces = [(int(model.jnt_dofadr[model.joint(name).id]), force) for name, force in setup.forces.items()]
    for number in range(round(seconds / step)):
        share = np.sin(2.0 * np.pi * number * step / PERIOD)
        for dof, force in forces:
            data.qfrc_applied[dof] = force * share
        mujoco.mj_step(model, data)
    mujoco.mj_kinematics(model, data)  # a step leaves the poses of bodies where they were before it
    return {model.body(number).name: data.xpos[number].copy() for number in range(1, model.nbody)}
