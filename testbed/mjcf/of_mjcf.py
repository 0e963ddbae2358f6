"""A file of MJCF as MuJoCo reads it, against our SDF or URDF of it as Drake reads that.

The n-th link is the n-th body of MuJoCo, but for links that stand between two joints of one body; so it is with joints.
Compared are masses, types and ranges of joints, and at random positions and velocities the poses of all links, the mass
matrix and the bias forces. What only MJCF has and the ledger names, such as the inertia of rotors, is taken out first.
"""

import importlib
import logging
import math
import warnings
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from lxml import etree

from testbed.mjcf.compiled import BALL, FREE, Array, Compiled, pose_of
from testbed.mjcf.differences import TOLERANCE, compare, speeds
from testbed.mjcf.from_drake import LOOSE, quaternion_of
from twinform.compiler.conversion import Conversion
from twinform.ir import Document, Joint, Link, Model
from twinform.passes.carriers.annotations import MADE_NAME, WORLDBODY, find_annotation, is_synthesized
from twinform.passes.carriers.carriers import NAMESPACE
from twinform.testing.oracles.robot import inverse
from twinform.testing.oracles.robot_comparison import IN_CHAINS

_POSITIONS = 4
_UNSEEN = ("visual", "collision", "sensor", "light", "physics", "wind", "magnetic_field", "mimic", "gazebo")
"""Elements that have nothing to do with mass and motion; meshes among them may be missing."""
_TYPES = {1: "ball", 2: "prismatic", 3: "revolute"}
_FLOATS = 1e-5
_ALMOST_NOTHING = "1e-22"
"""In kg and kg m^2: Drake asks for some mass."""
_BETWEEN = ("made", "part")
"""What links have in them that stand for no body."""
_NOTHING = 1e-11
"""In kg: what weighs less weighs nothing in MJCF."""


class Tree(NamedTuple):
    """A model of the document, with the numbers that MuJoCo has for its links and joints.

    `free` is the number of the joint of a root that floats.
    """

    model: Model
    bodies: dict[str, int]
    joints: dict[str, tuple[int, Joint]]
    free: int | None

    @property
    def root(self) -> str:
        """The name of the link that all others hang from."""
        return next(iter(self.bodies))


def trees_of(source: Compiled, document: Document) -> list[Tree] | str:
    """Return the models of a document that bodies were read as, or say what keeps them from being found."""
    model = source.model
    bodies = iter(range(1, model.nbody))
    joints = iter([number for number in range(model.njnt) if model.jnt_type[number] != FREE])
    free = {int(model.jnt_bodyid[number]): number for number in range(model.njnt) if model.jnt_type[number] == FREE}
    found: list[Tree] = []
    for each in [*document.models, *(inner for world in document.worlds for inner in world.models)]:
        if each.static and each.name == WORLDBODY and find_annotation(each, MADE_NAME) is not None:
            continue
        links = [link.name for link in each.links if not is_synthesized(link)]
        moving = [joint for joint in each.joints if joint.type != "fixed" and not _closes(joint, each)]
        numbered = dict(zip(links, bodies, strict=False))
        named = {joint.name: (number, joint) for joint, number in zip(moving, joints, strict=False)}
        found.append(Tree(each, numbered, named, free.get(next(iter(numbered.values()), 0))))
    if next(bodies, None) is not None or next(joints, None) is not None:
        return "MuJoCo has more bodies or joints"
    return found


def _closes(joint: Joint, model: Model) -> bool:
    """Whether a joint closes a loop: its child hangs from an earlier one."""
    return next(each for each in model.joints if each.child == joint.child) is not joint


def without_rotors(mujoco: Any, path: Path) -> Compiled:
    """MuJoCo's model of a file without what only MJCF has and the mass matrix shows: inertia of rotors and tendons.

    A free body stays where the file draws it: `alignfree` puts its frame into its center of mass in the compiled model,
    and what the file places in the body is placed from the drawn frame.

    Raises:
        ValueError: MuJoCo refuses the file.
    """
    # from_file knows MJCF by the end of its name
    drawn = mujoco.MjSpec.from_file(str(path)) if path.suffix == ".xml" else mujoco.MjSpec.from_string(path.read_text())
    drawn.compiler.alignfree = False
    for joint in drawn.joints:
        joint.align = 0
    with warnings.catch_warnings(action="ignore"):  # of settings that it will not have in a later version
        model = drawn.compile()
    model.dof_M0[:] -= model.dof_armature  # of bodies whose mass matrix is the same everywhere
    for name in ("dof_armature", "tendon_armature"):
        getattr(model, name)[:] = 0.0
    model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_GRAVITY)
    return Compiled(mujoco, model)


def differences_in_sdf(source: Compiled, made: Conversion) -> list[str]:
    """Return what differs between a file and the SDF that it became, as Drake reads that."""
    trees = trees_of(source, made.document)
    if isinstance(trees, str):
        return [trees]
    there = _InDrake(source, _bare(made.text, _loops_of(trees)), trees, {})
    return [*_of_joints(source, trees), *there.differences()]


def differences_in_urdf(source: Compiled, tree: Tree, made: Conversion) -> list[str]:
    """Return what differs between one tree of a file and the URDF that it became, as Drake reads that."""
    offsets = {each.name: _offset_of(each) for each in made.document.models[0].links}
    return _InDrake(source, _bare(made.text, _loops_of([tree])), [tree], offsets).differences()


def _of_joints(source: Compiled, trees: Iterable[Tree]) -> Iterator[str]:
    """Yield the joints whose type or range is another one in the document."""
    model = source.model
    for number, joint in (each for tree in trees for each in tree.joints.values()):
        if joint.type != _TYPES[int(model.jnt_type[number])]:
            yield f"joint {joint.name} is {joint.type}"
        if joint.type == "ball":
            continue
        limit = joint.axis.limit if joint.axis else None
        ends = (limit.lower, limit.upper) if limit else (None, None)
        here = [-math.inf if ends[0] is None else ends[0], math.inf if ends[1] is None else ends[1]]
        drawn = model.qpos0[model.jnt_qposadr[number]]
        wanted = model.jnt_range[number] - drawn if model.jnt_limited[number] else [-math.inf, math.inf]
        if not np.allclose(here, wanted, rtol=TOLERANCE, atol=TOLERANCE):
            yield f"joint {joint.name} moves from {here[0]} to {here[1]}, and in MuJoCo from {wanted[0]} to {wanted[1]}"


def _bare(text: str, loops: Collection[str] = ()) -> bytes:
    """Return a text without shapes and all else that does not matter, and without the joints that close loops.

    Links that stand between two joints of one body, or in the chain of joints that a ball becomes, weigh next to
    nothing there, which a body of a fly is not more than.
    """
    root = etree.fromstring(text.encode())
    between = [link for name in _BETWEEN for link in root.iterfind(f".//link/{{{NAMESPACE}}}{name}/..")]
    for made in between:
        for each in made.iter("mass", "ixx", "iyy", "izz"):
            each.text = _ALMOST_NOTHING
            if each.get("value"):  # in URDF
                each.set("value", _ALMOST_NOTHING)
        for each in made.iter("inertia"):
            each.attrib.update({name: _ALMOST_NOTHING for name in ("ixx", "iyy", "izz") if each.get(name)})
    closing = [each for each in root.iter("joint") if each.get("name") in loops]
    for each in [*root.iter(*_UNSEEN), *root.iter(f"{{{NAMESPACE}}}*"), *closing]:
        holder = each.getparent()
        if holder is not None:
            holder.remove(each)
    return etree.tostring(root)


def _loops_of(trees: Iterable[Tree]) -> frozenset[str]:
    """Return the names of the joints that close loops."""
    return frozenset(each.name for tree in trees for each in tree.model.joints if _closes(each, tree.model))


class _Freedom(NamedTuple):
    """A joint of MuJoCo and what stands for it in Drake: one joint, or three that turn about z, y and x."""

    number: int
    kind: int
    drake: Sequence[Any]


class _InDrake:
    """A text of SDF or URDF that was made of some trees, in Drake."""

    def __init__(self, source: Compiled, text: bytes, trees: Sequence[Tree], offsets: Mapping[str, Array]) -> None:
        plants: Any = importlib.import_module("pydrake.multibody.plant")
        parsing: Any = importlib.import_module("pydrake.multibody.parsing")
        logging.getLogger("drake").setLevel(logging.CRITICAL)
        self.source, self.trees, self.offsets = source, trees, offsets
        self.plant = plants.MultibodyPlant(0.0)
        is_urdf = b"<robot" in text
        made = parsing.Parser(self.plant).AddModelsFromString(text.decode(), "urdf" if is_urdf else "sdf")
        for constraint in self.plant.GetConstraintIds():
            self.plant.RemoveConstraint(constraint)
        self.plant.Finalize()
        self.plant.mutable_gravity_field().set_gravity_vector(source.model.opt.gravity)
        self.context = self.plant.CreateDefaultContext()
        self.instances = {
            tree.model.name: made[0] if is_urdf else self.plant.GetModelInstanceByName(tree.model.name)
            for tree in trees
        }
        self.freedoms = [freedom for tree in trees for freedom in self._freedoms(tree)]
        self.tolerance = IN_CHAINS if any(len(each.drake) > 1 for each in self.freedoms) else LOOSE

    def _freedoms(self, tree: Tree) -> Iterator[_Freedom]:
        instance = self.instances[tree.model.name]
        if tree.free is not None:
            floating = self._body(tree, tree.root).index()
            joints = (self.plant.get_joint(index) for index in self.plant.GetJointIndices())
            yield _Freedom(tree.free, FREE, [each for each in joints if each.child_body().index() == floating])
        for name, (number, joint) in tree.joints.items():
            named = self.plant.HasJointNamed(f"{name}_z", instance) and joint.type == "ball"
            names = [f"{name}_z", f"{name}_y", name] if named else [name]
            found = [self.plant.GetJointByName(each, instance) for each in names]
            yield _Freedom(number, int(self.source.model.jnt_type[number]), found)

    def _body(self, tree: Tree, link: str) -> Any:
        return self.plant.GetBodyByName(link, self.instances[tree.model.name])

    def differences(self) -> list[str]:
        """The first difference of each kind."""
        found: dict[str, str] = {}
        self._compare_masses(found)
        draw = np.random.default_rng(1)
        for _ in range(_POSITIONS):
            self._compare_motion(found, draw)
        return list(found.values())

    def _compare_masses(self, found: dict[str, str]) -> None:
        # MuJoCo has the points of meshes in single precision.
        data, close = self.source.data, _FLOATS if self.source.model.nmesh else TOLERANCE
        for tree in self.trees:
            if tree.model.static:
                continue
            for name, number in tree.bodies.items():
                theirs = _mass_in_drake(self._body(tree, name), self.offsets.get(name, np.eye(4)))
                ours = _mass_in_mujoco(data, self.source.model, number)
                if max(ours[0, 0], theirs[0, 0]) < _NOTHING:
                    continue
                size = max(ours[0, 0], 1e-3)
                compare(found, f"the mass of link {name!r}", ours[0] / size, theirs[0] / size, close)
                size = max(np.abs(ours[1:]).max(), 1e-4)
                compare(found, f"the inertia of link {name!r}", ours[1:] / size, theirs[1:] / size, close)

    def _compare_motion(self, found: dict[str, str], draw: np.random.Generator) -> None:
        plant, context, model = self.plant, self.context, self.source.model
        positions = model.qpos0.copy()
        velocities = np.zeros(plant.num_velocities())
        for each in self.freedoms:
            self._draw(each, positions, velocities, draw)
        plant.SetVelocities(context, velocities)
        turn = self._turn()
        here = self.source.at(positions, turn @ velocities)
        mass = turn.T @ here.mass @ turn
        size = self._sizes(mass)
        scale = np.outer(size, size)
        compare(found, "the mass matrix", mass * scale, plant.CalcMassMatrix(context) * scale, self.tolerance)
        bias = plant.CalcBiasTerm(context) - plant.CalcGravityGeneralizedForces(context)
        compare(found, "the bias forces", turn.T @ here.bias, bias, self.tolerance)
        for tree in self.trees:
            for name, number in tree.bodies.items():
                pose = plant.EvalBodyPoseInWorld(context, self._body(tree, name)).GetAsMatrix4()
                pose = pose @ self.offsets.get(name, np.eye(4))
                wanted = pose_of(self.source.data.xpos[number], self.source.data.xmat[number])
                compare(found, f"the pose of link {name!r}", wanted, pose)

    def _sizes(self, mass: Array) -> Array:
        """What makes the diagonal of a mass matrix one, so that a finger counts as much as the arm that holds it."""
        diagonal = np.diagonal(mass)
        return 1.0 / np.sqrt(np.where(diagonal > _NOTHING, diagonal, 1.0))

    def _draw(self, one: _Freedom, there: Array, velocities: Array, draw: np.random.Generator) -> None:
        """Put a joint at a random position in both programs, and give it a velocity."""
        positions = self.plant.GetPositions(self.context)
        at = int(self.source.model.jnt_qposadr[one.number])
        start = one.drake[0].position_start()
        angles = draw.uniform(-1.0, 1.0, 3)
        for joint in one.drake:
            count = joint.num_velocities()
            # Three joints are one turn in another notation, whose rates are compared at rest.
            speed = speeds(draw, count) if len(one.drake) == 1 else np.zeros(count)
            velocities[joint.velocity_start() : joint.velocity_start() + count] = speed
        if one.kind == FREE:
            turn = draw.normal(size=4)
            turn /= np.linalg.norm(turn)
            positions[start : start + 7] = [*turn, *angles]
            there[at : at + 7] = [*angles, *turn]
        elif len(one.drake) == 1 and one.kind == BALL:
            positions[start : start + 3] = angles
        elif one.kind == BALL:
            for joint, angle in zip(one.drake, angles, strict=True):
                positions[joint.position_start()] = angle
        else:
            positions[start] = angles[0]
            there[at] += angles[0]
        self.plant.SetPositions(self.context, positions)
        if one.kind == BALL:
            there[at : at + 4] = quaternion_of(self._turn_of(one))

    def _turn_of(self, one: _Freedom) -> Array:
        """How far a ball joint is turned from where it is drawn."""
        turn = np.eye(3)
        for joint in one.drake:
            turn = turn @ joint.frame_on_child().CalcPose(self.context, joint.frame_on_parent()).rotation().matrix()
        return turn

    def _turn(self) -> Array:
        """The matrix from the velocities of Drake to those of MuJoCo."""
        model = self.source.model
        matrix = np.zeros((model.nv, self.plant.num_velocities()))
        for one in self.freedoms:
            row, start = int(model.jnt_dofadr[one.number]), one.drake[0].velocity_start()
            if one.kind == FREE:
                body = one.drake[0].child_body()
                turn = self.plant.EvalBodyPoseInWorld(self.context, body).rotation().matrix()
                matrix[row : row + 3, start + 3 : start + 6] = np.eye(3)
                matrix[row + 3 : row + 6, start : start + 3] = turn.T
            elif len(one.drake) == 1 and one.kind == BALL:
                matrix[row : row + 3, start : start + 3] = self._turn_of(one).T
            elif one.kind == BALL:
                left = np.eye(3)
                for joint in reversed(one.drake):
                    moved = joint.frame_on_child().CalcPose(self.context, joint.frame_on_parent()).rotation().matrix()
                    matrix[row : row + 3, joint.velocity_start()] = left.T @ joint.revolute_axis()
                    left = moved @ left
            else:
                matrix[row, start] = 1.0
        return matrix


def _mass_in_drake(body: Any, offset: Array) -> Array:
    """The mass with three zeros, the center in m, and the inertia about it, in the frame of the link at an offset."""
    inertia: Any = body.default_spatial_inertia()
    mass, center = inertia.get_mass(), inertia.get_com()
    about = inertia.Shift(center).CalcRotationalInertia().CopyToFullMatrix3()
    back: Array = inverse(offset)
    return _rows(mass, back[:3, :3] @ center + back[:3, 3], back[:3, :3] @ about @ back[:3, :3].T)


def _mass_in_mujoco(data: Any, model: Any, number: int) -> Array:
    mujoco: Any = importlib.import_module("mujoco")
    flat = np.zeros(9)
    mujoco.mju_quat2Mat(flat, model.body_iquat[number])
    turn = flat.reshape(3, 3)
    inertia = turn @ np.diag(model.body_inertia[number]) @ turn.T
    return _rows(float(model.body_mass[number]), model.body_ipos[number], inertia)


def _rows(mass: float, center: Array, inertia: Array) -> Array:
    return np.vstack([[mass, *(mass * center)], np.hstack([inertia, np.zeros((3, 1))])])


def _offset_of(link: Link) -> Array:
    """The frame that a link has in SDF, in the one that it has in URDF."""
    found = find_annotation(link, "offset")
    at = np.eye(4)
    if found is not None:
        maths: Any = importlib.import_module("pydrake.math")
        xyz, rpy = ([float(each) for each in (found.get(name) or "0 0 0").split()] for name in ("xyz", "rpy"))
        at = maths.RigidTransform(maths.RollPitchYaw(rpy), xyz).GetAsMatrix4()
    return at
