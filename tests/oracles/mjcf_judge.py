"""Is what twinform reads of MJCF the robot that MuJoCo reads? Drake judges the SDF, and MuJoCo the URDF.

Bodies, masses, inertias, types of joints and limits are compared, and where the bodies are at random positions. The
n-th link is the n-th body of MuJoCo, but for those that stand between two joints of one body; so it is with joints.
"""

import importlib
import logging
import math
from collections.abc import Collection, Iterable, Iterator
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import pytest
from lxml import etree

import twinform
from twinform.ir import Document, Joint, Link, Model
from twinform.passes.carriers.annotations import MADE_NAME, find_annotation, is_synthesized
from twinform.passes.carriers.carriers import NAMESPACE

mujoco: Any = pytest.importorskip("mujoco")
np: Any = pytest.importorskip("numpy")

CLOSE = 1e-9
"""How far numbers may be apart: in m, rad and kg, and relative to the largest one of a body."""
_SAMPLES = 4
_UNSEEN = ("visual", "collision", "sensor", "light", "physics", "wind", "magnetic_field", "mimic", "gazebo")
"""Elements that have nothing to do with mass and motion; meshes among them may be missing."""
_FREE, _BALL = 0, 1
_TYPES = {1: "ball", 2: "prismatic", 3: "revolute"}


class BodyMass(NamedTuple):
    """The mass, its center, and the inertia about it in the axes of the body."""

    mass: float
    center: Any
    inertia: Any

    def differs(self, other: "BodyMass", close: float) -> str:
        """Say what differs; nothing where the bodies are the same, or weigh next to nothing."""
        if max(self.mass, other.mass) < 1e-11:
            return ""
        if abs(self.mass - other.mass) > close * max(1e-3, self.mass):
            return f"weighs {self.mass} and {other.mass}"
        if np.abs(self.center - other.center).max() > close:
            return f"has its mass at {self.center} and {other.center}"
        largest = max(np.abs(self.inertia).max(), 1e-4)
        if np.abs(self.inertia - other.inertia).max() > close * largest:
            return f"has the inertia {self.inertia} and {other.inertia}"
        return ""


class Tree(NamedTuple):
    """A model of the document, with the numbers that MuJoCo has for its links and joints."""

    model: Model
    bodies: dict[str, int]
    joints: dict[str, tuple[int, Joint]]


def differences(source: Path, paths: tuple[Path, ...] = (), close: float = CLOSE) -> list[str]:
    """Return what differs between MuJoCo's reading of a file and ours.

    Raises:
        ValueError: MuJoCo refuses the file.
    """
    compiled = mujoco.MjModel.from_xml_path(str(source))
    made = twinform.convert(source, to="sdf", paths=paths)
    trees = _trees(compiled, made.document)
    if isinstance(trees, str):
        return [trees]
    found = [*_of_joints(compiled, trees), *_of_sdf(compiled, made.text, trees, close)]
    return [*found, *(each for tree in trees for each in _of_urdf(compiled, source, paths, tree, made.document, close))]


def _trees(compiled: Any, document: Document) -> list[Tree] | str:
    models = [*document.models, *(each for world in document.worlds for each in world.models)]
    bodies = iter(range(1, compiled.nbody))
    joints = iter([number for number in range(compiled.njnt) if compiled.jnt_type[number] != _FREE])
    trees: list[Tree] = []
    for model in models:
        if find_annotation(model, MADE_NAME) is not None and model.static:
            continue
        links = [each.name for each in model.links if not is_synthesized(each)]
        moving = [each for each in model.joints if each.type != "fixed" and not _closes(each, model)]
        trees.append(
            Tree(
                model,
                dict(zip(links, bodies, strict=False)),
                {each.name: (number, each) for each, number in zip(moving, joints, strict=False)},
            )
        )
    if next(bodies, None) is not None or next(joints, None) is not None:
        return "MuJoCo has more bodies or joints"
    return trees


def _closes(joint: Joint, model: Model) -> bool:
    """Whether a joint closes a loop: its child hangs from an earlier one."""
    return next(each for each in model.joints if each.child == joint.child) is not joint


def _of_joints(compiled: Any, trees: list[Tree]) -> Iterator[str]:
    for number, joint in (each for tree in trees for each in tree.joints.values()):
        if joint.type != _TYPES[int(compiled.jnt_type[number])]:
            yield f"joint {joint.name} is {joint.type}"
        if joint.type != "ball":
            yield from _of_limits(compiled, number, joint)


def _of_limits(compiled: Any, number: int, joint: Joint) -> Iterator[str]:
    limit = joint.axis.limit if joint.axis else None
    ends = (limit.lower, limit.upper) if limit else (None, None)
    drawn = compiled.qpos0[compiled.jnt_qposadr[number]]
    wanted = [each - drawn for each in compiled.jnt_range[number]] if compiled.jnt_limited[number] else [None, None]
    if ends != pytest.approx(tuple(wanted), abs=CLOSE):
        yield f"joint {joint.name} moves from {ends[0]} to {ends[1]}, and in MuJoCo from {wanted[0]} to {wanted[1]}"


def _of_sdf(compiled: Any, text: str, trees: list[Tree], close: float) -> Iterator[str]:
    drake = _Drake(
        _bare(text, {each.name for tree in trees for each in tree.model.joints if _closes(each, tree.model)})
    )
    for number, (data, drawn) in enumerate(_positions(compiled)):
        drake.move(compiled, drawn, trees)
        for tree in trees:
            for name, body in tree.bodies.items():
                apart = np.abs(drake.pose(tree.model, name) - _pose(data, body)).max()
                if apart > CLOSE * max(1.0, np.abs(data.xpos[body]).max()):
                    yield f"link {name} is {apart} m away in Drake"
                told = drake.mass(tree.model, name).differs(_mass(compiled, body), close) if number == 0 else ""
                if told and not tree.model.static:
                    yield f"link {name} {told} in Drake and MuJoCo"


def _bare(text: str, loops: Collection[str] = ()) -> bytes:
    """Return a text without shapes and all else that does not matter, and without the joints that close loops."""
    root = etree.fromstring(text.encode())
    closing = [each for each in root.iter("joint") if each.get("name") in loops]
    for each in [*root.iter(*_UNSEEN), *root.iter(f"{{{NAMESPACE}}}*"), *closing]:
        holder = each.getparent()
        if holder is not None:
            holder.remove(each)
    return etree.tostring(root)


class _Drake:
    """A plant of Drake."""

    def __init__(self, text: bytes) -> None:
        plants: Any = importlib.import_module("pydrake.multibody.plant")
        parsing: Any = importlib.import_module("pydrake.multibody.parsing")
        logging.getLogger("drake").setLevel(logging.CRITICAL)
        self.plant = plants.MultibodyPlant(0.0)
        parsing.Parser(self.plant).AddModelsFromString(text.decode(), "sdf")
        self.plant.Finalize()
        self.context = self.plant.CreateDefaultContext()

    def move(self, compiled: Any, drawn: dict[int, Any], trees: Iterable[Tree]) -> None:
        """Put all joints where MuJoCo has them."""
        for tree in trees:
            instance = self.plant.GetModelInstanceByName(tree.model.name)
            for name, (number, joint) in tree.joints.items():
                found = self.plant.GetJointByName(name, instance)
                if joint.type == "ball":
                    z, y, x = _angles(drawn[number])
                    found.set_angles(self.context, [x, y, z])
                else:
                    positions = self.plant.GetPositions(self.context)
                    positions[found.position_start()] = drawn[number]
                    self.plant.SetPositions(self.context, positions)

    def _body(self, model: Model, link: str) -> Any:
        return self.plant.GetBodyByName(link, self.plant.GetModelInstanceByName(model.name))

    def pose(self, model: Model, link: str) -> Any:
        """Return the pose of a link in the world."""
        return self.plant.EvalBodyPoseInWorld(self.context, self._body(model, link)).GetAsMatrix4()

    def mass(self, model: Model, link: str) -> BodyMass:
        """Return the mass of a link."""
        spatial = self._body(model, link).CalcSpatialInertiaInBodyFrame(self.context)
        mass, center = spatial.get_mass(), spatial.get_com()
        about = spatial.CalcRotationalInertia().CopyToFullMatrix3()
        return BodyMass(mass, center, about - mass * (center @ center * np.eye(3) - np.outer(center, center)))


def _of_urdf(
    compiled: Any, source: Path, paths: tuple[Path, ...], tree: Tree, document: Document, close: float
) -> Iterator[str]:
    chosen = None if document.models else tree.model.name
    made = twinform.convert(source, to="urdf", paths=paths, model=chosen)
    offsets = {each.name: _offset(each) for each in made.document.models[0].links}
    urdf = mujoco.MjModel.from_xml_string(_for_mujoco(made.text))
    bodies = {urdf.body(number).name: number for number in range(urdf.nbody)}
    joints = {urdf.joint(number).name: number for number in range(urdf.njnt)}
    first = next(iter(tree.bodies))
    for sample, (data, drawn) in enumerate(_positions(compiled)):
        state = mujoco.MjData(urdf)
        for name, (number, joint) in tree.joints.items():
            for suffix, position in _urdf_positions(joint, drawn[number]):
                state.qpos[urdf.jnt_qposadr[joints[name + suffix]]] = position
        mujoco.mj_kinematics(urdf, state)
        there, here = (
            np.linalg.inv(_pose(data, tree.bodies[first])),
            np.linalg.inv(_pose(state, bodies[first]) @ offsets[first]),
        )
        for name, body in tree.bodies.items():
            place = here @ _pose(state, bodies[name]) @ offsets[name]
            wanted = there @ _pose(data, body)
            if np.abs(place - wanted).max() > CLOSE * max(1.0, np.abs(wanted).max()):
                yield f"link {name} is {np.abs(place - wanted).max()} m away in the URDF"
            weight = _moved(_mass(urdf, bodies[name]), np.linalg.inv(offsets[name]))
            told = weight.differs(_mass(compiled, body), close) if sample == 0 else ""
            if told:
                yield f"link {name} {told} in the URDF and the MJCF"


def _for_mujoco(text: str) -> str:
    root = etree.fromstring(_bare(text))
    settings = {"fusestatic": "false", "inertiafromgeom": "false", "balanceinertia": "false"}
    etree.SubElement(etree.SubElement(root, "mujoco"), "compiler", settings)
    return etree.tostring(root).decode()


def _offset(link: Link) -> Any:
    """Return the frame that the link has in SDF, in the one that it has in URDF."""
    found = find_annotation(link, "offset")
    at = np.eye(4)
    if found is not None:
        at[:3, 3] = [float(each) for each in (found.get("xyz") or "0 0 0").split()]
        roll, pitch, yaw = (float(each) for each in (found.get("rpy") or "0 0 0").split())
        at[:3, :3] = _about(2, yaw) @ _about(1, pitch) @ _about(0, roll)
    return at


def _about(axis: int, angle: float) -> Any:
    one, other = [each for each in range(3) if each != axis]
    if axis == 1:
        one, other = other, one
    turn = np.eye(3)
    turn[one, one] = turn[other, other] = math.cos(angle)
    turn[other, one], turn[one, other] = math.sin(angle), -math.sin(angle)
    return turn


def _urdf_positions(joint: Joint, drawn: Any) -> list[tuple[str, float]]:
    if joint.type != "ball":
        return [("", drawn)]
    return list(zip(("_z", "_y", ""), _angles(drawn), strict=True))


def _angles(quaternion: Any) -> tuple[float, float, float]:
    """Return yaw, pitch and roll."""
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, quaternion)
    r = turn.reshape(3, 3)
    pitch = math.atan2(-r[2, 0], math.hypot(r[2, 1], r[2, 2]))
    return math.atan2(r[1, 0], r[0, 0]), pitch, math.atan2(r[2, 1], r[2, 2])


def _positions(compiled: Any) -> Iterator[tuple[Any, dict[int, Any]]]:
    """Yield states at random positions, with the distance of each joint from where it is drawn."""
    random = Random(1)
    for _ in range(_SAMPLES):
        data, drawn = mujoco.MjData(compiled), dict[int, Any]()
        for number in range(compiled.njnt):
            start, kind = compiled.jnt_qposadr[number], compiled.jnt_type[number]
            if kind == _BALL:
                quaternion = np.array([random.gauss(0, 1) for _ in range(4)])
                drawn[number] = data.qpos[start : start + 4] = quaternion / np.linalg.norm(quaternion)
            elif kind != _FREE:
                drawn[number] = random.uniform(-1.5, 1.5)
                data.qpos[start] = compiled.qpos0[start] + drawn[number]
        mujoco.mj_kinematics(compiled, data)
        yield data, drawn


def _pose(data: Any, body: int) -> Any:
    at = np.eye(4)
    at[:3, :3], at[:3, 3] = data.xmat[body].reshape(3, 3), data.xpos[body]
    return at


def _mass(compiled: Any, body: int) -> BodyMass:
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, compiled.body_iquat[body])
    r = turn.reshape(3, 3)
    inertia = r @ np.diag(compiled.body_inertia[body]) @ r.T
    return BodyMass(float(compiled.body_mass[body]), compiled.body_ipos[body].copy(), inertia)


def _moved(one: BodyMass, at: Any) -> BodyMass:
    """Return a mass seen from the frame that `at` places its own in."""
    r = at[:3, :3]
    return BodyMass(one.mass, r @ one.center + at[:3, 3], r @ one.inertia @ r.T)
