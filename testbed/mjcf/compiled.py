"""A model as MuJoCo compiles it: its joints, bodies, and the equations of motion at given positions.

The URDF reader of MuJoCo may merge links, leave visuals out and change inertias: all of that is off here.
"""

import contextlib
import importlib
import tempfile
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from lxml import etree

from twinform.ir.defaults import UNLIMITED

Array = Any
"""An array of numpy."""
_OFF: tuple[str, ...] = ("fusestatic", "discardvisual", "balanceinertia", "strippath")
"""What MuJoCo does to a URDF unless it is told not to."""
_SIZES = {2: 1, 3: 2, 5: 2}
"""How many sizes mean something of a sphere, capsule and cylinder."""
_OF_ROTORS = ("actuator/{*}gear_ratio", "actuator/{*}rotor_inertia")
"""What Drake says of a motor in a transmission of URDF."""
FREE, BALL, SLIDE, HINGE = range(4)
"""The types of joints, with MuJoCo's numbers."""
MESH = 7
"""The type of a geom that is a mesh."""


class UnreadableError(Exception):
    """MuJoCo refuses a model; the message says why."""


class JointFacts(NamedTuple):
    """What a joint of one freedom may do: its type, range, force, damping, friction and spring.

    A range or force that is not limited is empty; a force as large as what a URDF or SDF has for none is not limited.
    """

    kind: int
    range: tuple[float, ...]
    force: tuple[float, ...]
    damping: float
    friction: float
    stiffness: float
    spring: float


class GeomFacts(NamedTuple):
    """The body of a geom, its type, whether anything can touch it, and its sizes."""

    body: str
    kind: int
    touches: bool
    size: tuple[float, ...]

    @property
    def is_mesh(self) -> bool:
        """Whether it is a mesh, which has the axes of its inertia: numbers and turns of a symmetric one are chance."""
        return self.kind == MESH


@dataclass(frozen=True)
class Motion:
    """The state of a model: mass matrix, bias forces, and the poses of bodies, sites and geoms as 4x4 matrices."""

    mass: Array
    bias: Array
    bodies: Mapping[str, Array]
    geoms: Sequence[Array]


@dataclass
class Compiled:
    """A compiled model."""

    mujoco: Any
    model: Any
    data: Any = field(init=False)

    def __post_init__(self) -> None:
        # Contacts and limits are no part of what is compared, and of a hundred robots in one place there are too many.
        self.model.opt.disableflags |= int(self.mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
        self.model.opt.disableflags |= int(self.mujoco.mjtDisableBit.mjDSBL_CONTACT)
        self.data = self.mujoco.MjData(self.model)

    @cached_property
    def joints(self) -> dict[str, int]:
        """The numbers of the joints by name; one without a name has that of its body, or none but its place."""
        found = dict[str, int]()
        for number in range(self.model.njnt):
            name = self.model.joint(number).name or self.body_of(number) or "the first joint without a name"
            found[name if name not in found else f"joint {number} without a name"] = number
        return found

    def body_of(self, number: int) -> str:
        """The name of the body that a joint moves."""
        return str(self.model.body(int(self.model.jnt_bodyid[number])).name)

    def facts(self, number: int) -> JointFacts:
        """What a joint may do."""
        model = self.model
        dof = int(model.jnt_dofadr[number])
        limited = bool(model.jnt_limited[number])
        ends = tuple(map(float, model.jnt_range[number]))
        strong = bool(model.jnt_actfrclimited[number]) and float(model.jnt_actfrcrange[number][1]) < UNLIMITED
        return JointFacts(
            int(model.jnt_type[number]),
            ends if limited and not all(abs(each) >= UNLIMITED for each in ends) else (),
            tuple(map(float, model.jnt_actfrcrange[number])) if strong else (),
            float(model.dof_damping[dof]),
            float(model.dof_frictionloss[dof]),
            float(model.jnt_stiffness[number]),
            float(model.qpos_spring[int(model.jnt_qposadr[number])]),
        )

    def geom(self, number: int) -> GeomFacts:
        """What a geom is."""
        model = self.model
        body = str(model.body(int(model.geom_bodyid[number])).name)
        touches = bool(model.geom_contype[number] or model.geom_conaffinity[number])
        kind = int(model.geom_type[number])
        size = () if kind == MESH else tuple(map(float, model.geom_size[number]))
        return GeomFacts(body, kind, touches, size[: _SIZES.get(kind)])

    def bounds(self, number: int) -> Array:
        """The least and the greatest coordinates of a mesh in the world, where it is now."""
        model, mesh = self.model, int(self.model.geom_dataid[number])
        start, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
        turn, place = self.data.geom_xmat[number].reshape(3, 3), self.data.geom_xpos[number]
        points = model.mesh_vert[start : start + count].astype(float) @ turn.T + place
        return np.stack([points.min(axis=0), points.max(axis=0)])

    def at(self, positions: Array, velocities: Array) -> Motion:
        """The motion at positions and velocities, in the order of this model."""
        mujoco, model, data = self.mujoco, self.model, self.data
        data.qpos[:], data.qvel[:] = positions, velocities
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            mujoco.mj_forward(model, data)
        mass = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass)
        named = (i for i in range(1, model.nbody) if model.body(i).name)  # names are made for others
        poses = {model.body(i).name: pose_of(data.xpos[i], data.xmat[i]) for i in named}
        places = (i for i in range(model.nsite) if model.site(i).name)
        sites = {model.site(i).name: pose_of(data.site_xpos[i], data.site_xmat[i]) for i in places}
        geoms = [pose_of(data.geom_xpos[i], data.geom_xmat[i]) for i in range(model.ngeom)]
        return Motion(mass, data.qfrc_bias.copy(), sites | poses, geoms)


def pose_of(place: Array, rotation: Array) -> Array:
    """A place and a rotation of MuJoCo as a 4x4 matrix."""
    made = np.eye(4)
    made[:3, :3], made[:3, 3] = np.reshape(rotation, (3, 3)), place
    return made


def compile_urdf(text: bytes, *, absent_is_nothing: bool) -> Compiled:
    """Compile a URDF with all of its links and visuals.

    A link without inertial has no mass with `absent_is_nothing`, and else what MuJoCo makes of its collisions.

    Raises:
        UnreadableError: MuJoCo refuses it.
    """
    off = ["fusestatic", "discardvisual", "balanceinertia", "strippath"]
    if absent_is_nothing:
        off.append("inertiafromgeom")
    settings = dict.fromkeys(off, "false")
    parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True)
    try:
        robot = etree.fromstring(text, parser)
    except etree.XMLSyntaxError as error:
        raise UnreadableError(f"it is not XML: {error}") from error
    for own in robot.findall("mujoco"):
        robot.remove(own)
    etree.SubElement(etree.SubElement(robot, "mujoco"), "compiler", settings)
    return compile_mjcf(etree.tostring(robot, encoding="unicode"))


def turn_rotors(urdf: bytes, robot: Compiled) -> None:
    """Give a compiled URDF the inertia of rotors that elements of Drake in it state, which MuJoCo's reader skips."""
    for transmission in etree.fromstring(urdf).iterfind("transmission"):
        joint, ratio, inertia = (transmission.find(path) for path in ("joint", *_OF_ROTORS))
        if joint is not None and inertia is not None:
            dof = int(robot.model.jnt_dofadr[robot.joints[str(joint.get("name"))]])
            geared = float(1 if ratio is None else ratio.get("value", 1)) ** 2
            robot.model.dof_armature[dof] += float(inertia.get("value", 0)) * geared
            robot.model.dof_M0[dof] += float(inertia.get("value", 0)) * geared  # where the mass matrix never changes


def without_meshes(text: str) -> str:
    """MJCF without its meshes, textures and height fields, without their geoms, and without what names these."""
    root = etree.fromstring(text.encode())
    gone = [*root.iterfind(".//geom[@mesh]"), *root.iterfind(".//geom[@hfield]")]
    names = {geom.get("name") for geom in gone} - {None}
    naming = [each for each in root.iterfind("sensor/*") if names & {each.get("geom1"), each.get("geom2")}]
    for each in [*root.iterfind("asset"), *gone, *naming]:
        around = each.getparent()
        if around is not None:
            around.remove(each)
    for geom in root.iterfind(".//geom[@material]"):
        del geom.attrib["material"]
    return etree.tostring(root, encoding="unicode")


def compile_mjcf(text: str, folder: str | None = None) -> Compiled:
    """Compile a model; relative paths of files lead from `folder`.

    Raises:
        UnreadableError: MuJoCo refuses it.
    """
    mujoco: Any = importlib.import_module("mujoco")
    # it writes its warnings to a file in the working directory
    # It warns of axes that are parallel, which a model may have.
    with tempfile.TemporaryDirectory() as made, contextlib.chdir(made), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            spec = mujoco.MjSpec.from_string(text)
            if folder is not None:
                spec.modelfiledir = folder
            return Compiled(mujoco, spec.compile())
        except (ValueError, mujoco.FatalError) as error:
            raise UnreadableError(" ".join(str(error).split())) from error
