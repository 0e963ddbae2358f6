"""Readers that build a robot which can move: DART, Drake, MuJoCo, Newton, Pinocchio, PyBullet, urdf-usd-converter."""

import importlib
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from testbed.engines.readers.answers import Answer, kept

_STILL = "what stands still"


def dart(path: Path) -> Answer:
    """The skeleton of DART's own reader, which stands on urdfdom; the joint above the root is its own."""
    utilities = _module("dartpy").utils
    skeleton = utilities.DartLoader().parseSkeleton(str(path))
    if skeleton is None:
        raise ValueError("no skeleton")
    bodies = [skeleton.getBodyNode(number) for number in range(skeleton.getNumBodyNodes())]
    roots = {body.getParentJoint().getName() for body in bodies if body.getParentBodyNode() is None} & {"rootJoint"}
    joints = (name for body in bodies if (name := body.getParentJoint().getName()) not in roots)
    masses = ((body.getName(), body.getMass()) for body in bodies)
    shapes = sum(body.getNumShapeNodes() for body in bodies)
    return Answer("", kept((body.getName() for body in bodies), joints, masses, shapes))


def drake(path: Path) -> Answer:
    """Its plant without geometry."""
    return _drake(path, _module("pydrake.multibody.plant").MultibodyPlant(0.001))


def drake_with_scene(path: Path) -> Answer:
    """Its plant with a scene graph, which looks at the shapes and their materials, too."""
    builder = _module("pydrake.systems.framework").DiagramBuilder()
    plant, _ = _module("pydrake.multibody.plant").AddMultibodyPlantSceneGraph(builder, 0.001)
    return _drake(path, plant)


def _drake(path: Path, plant: Any) -> Answer:
    models = _module("pydrake.multibody.parsing").Parser(plant).AddModels(str(path))
    plant.Finalize()
    bodies = [plant.get_body(body) for model in models for body in plant.GetBodyIndices(model)]
    # a body that nothing holds has a joint of six degrees of freedom with the name of the body
    free = {plant.get_body(body).name() for body in plant.GetFloatingBaseBodies()}
    joints = [plant.get_joint(joint).name() for model in models for joint in plant.GetJointIndices(model)]
    masses = ((body.name(), body.default_mass()) for body in bodies)
    return Answer("", kept((body.name() for body in bodies), (name for name in joints if name not in free), masses))


def mujoco(path: Path) -> Answer:
    """Its compiled model; what is fixed to the world, or to another body, is a part of that."""
    model = _module("mujoco").MjModel.from_xml_path(str(path))
    bodies = [model.body(i) for i in range(1, model.nbody)]
    joints = (model.joint(i).name for i in range(model.njnt))
    return Answer("", kept((body.name for body in bodies), joints, ((b.name, b.mass[0]) for b in bodies), model.ngeom))


def newton(path: Path) -> Answer:
    """The builder of a model, by its own reader of URDF; names have that of the robot before them."""
    builder = _module("newton").ModelBuilder()
    builder.add_urdf(str(path))
    links = [str(label).rpartition("/")[2] for label in builder.body_label]
    joints = [name for label in builder.joint_label if (name := str(label).rpartition("/")[2]) != "fixed_base"]
    return Answer("", kept(links, joints, zip(links, builder.body_mass, strict=True), builder.shape_count))


def pinocchio(path: Path) -> Answer:
    """Its model; masses by the joint that moves them, that of what stands still together."""
    library = _module("pinocchio")
    model = library.buildModelFromUrdf(str(path))
    kinds = library.FrameType
    frames = list(model.frames)[1:]  # after that of the universe
    links = [frame.name for frame in frames if frame.type == kinds.BODY]
    joints = (frame.name for frame in frames if frame.type in {kinds.JOINT, kinds.FIXED_JOINT})
    still = sum(frame.inertia.mass for frame in frames if frame.parentJoint == 0)
    moved = (
        (name, inertia.mass) for name, inertia in zip(list(model.names)[1:], list(model.inertias)[1:], strict=True)
    )
    return Answer(str(model), kept(links, joints, [(_STILL, still), *moved]))


def pybullet(path: Path) -> Answer:
    """A body in its physics server."""
    bullet = _module("pybullet")
    client = bullet.connect(bullet.DIRECT)
    load = bullet.loadURDF if path.suffix == ".urdf" else bullet.loadSDF
    loaded = load(str(path), physicsClientId=client)
    bodies = [loaded] if isinstance(loaded, int) else list(loaded)
    rows = [row for body in bodies for row in _bullet_rows(bullet, body)]
    shapes = sum(len(bullet.getVisualShapeData(body)) for body in bodies)
    links, joints, masses = zip(*rows, strict=True) if rows else ((), (), ())
    return Answer(str(loaded), kept(links, filter(None, joints), zip(links, masses, strict=True), shapes))


def _bullet_rows(bullet: Any, body: int) -> Iterator[tuple[str, str, float]]:
    """Each link with the joint above and its mass: the root first, which has no joint."""
    yield _decoded(bullet.getBodyInfo(body)[0]), "", bullet.getDynamicsInfo(body, -1)[0]
    for index in range(bullet.getNumJoints(body)):
        info = bullet.getJointInfo(body, index)
        yield _decoded(info[12]), _decoded(info[1]), bullet.getDynamicsInfo(body, index)[0]


def _decoded(name: bytes) -> str:
    return name.decode(errors="replace")


def urdf_usd_converter(path: Path) -> Answer:
    """The stage that it writes, by the names that were in the file: its rigid bodies and its joints."""
    physics, stages = _module("pxr.UsdPhysics"), _module("pxr.Usd").Stage
    with tempfile.TemporaryDirectory() as folder:
        asset = _module("urdf_usd_converter").Converter().convert(str(path), folder)
        stage = stages.Open(asset.path)
        prims = list(stage.Traverse())
        bodies = [prim for prim in prims if prim.HasAPI(physics.RigidBodyAPI)]
        joints = [_called(prim) for prim in prims if prim.IsA(physics.Joint) and prim.GetName() != "root_joint"]
        weighed = [(prim, physics.MassAPI(prim).GetMassAttr().Get()) for prim in bodies]
        masses = [(_called(prim), mass) for prim, mass in weighed if mass is not None]
        return Answer("", kept(map(_called, bodies), joints, masses))


def _called(prim: Any) -> str:
    return str(prim.GetDisplayName() or prim.GetName())


def _module(name: str) -> Any:
    return importlib.import_module(name)
