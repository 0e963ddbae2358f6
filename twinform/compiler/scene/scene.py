"""A scene: what there is to see of a document, and where it is with every joint at zero.

All frames are in the world's, lengths in meters, angles in radians, colors from 0 to 1. Names are those of SDF: parts
of nested models, and of models in a world, are `model::part`.
"""

from dataclasses import dataclass, field
from typing import Literal

from twinform.compiler.kinematics import Kinematics, PlacedJoint
from twinform.diagnostics import NOWHERE, Location
from twinform.ir import Color, Vector3
from twinform.ir.geometry import ShapeNode
from twinform.ir.solids import Solid
from twinform.ir.transform import Transform

Role = Literal["visual", "collision"]


@dataclass(frozen=True, slots=True)
class SceneShape:
    """A visual or collision; `pose` is in the frame of its link."""

    role: Role
    name: str
    pose: Transform
    shape: ShapeNode
    color: Color | None = None
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class Ray:
    """The measured part of a ray of a sensor, in the frame of the sensor."""

    start: Vector3
    end: Vector3


@dataclass(frozen=True, slots=True)
class Frustum:
    """The view of a camera along the x axis of its sensor: angles, and the nearest and farthest distance."""

    horizontal: float
    vertical: float
    near: float
    far: float
    pose: Transform = field(default_factory=Transform)


@dataclass(frozen=True, slots=True)
class SceneSensor:
    """A sensor; `pose` is in the frame of the link that it moves with."""

    name: str
    type: str
    link: str
    pose: Transform
    frustums: tuple[Frustum, ...] = ()
    rays: tuple[Ray, ...] = ()
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class SceneLink:
    """A link, the pose of its frame, and its mass in its own frame, which is None for a link without mass."""

    name: str
    pose: Transform
    shapes: tuple[SceneShape, ...] = ()
    mass: Solid | None = None
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class SceneJoint(PlacedJoint):
    """A joint of the scene."""

    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class SceneFrame:
    """A named frame, in the frame of the link that it moves with."""

    name: str
    link: str
    pose: Transform
    where: Location = NOWHERE


@dataclass(frozen=True, slots=True)
class Scene:
    """The parts of a document that can be seen; `left_out` says what could not be placed."""

    links: tuple[SceneLink, ...] = ()
    joints: tuple[SceneJoint, ...] = ()
    frames: tuple[SceneFrame, ...] = ()
    sensors: tuple[SceneSensor, ...] = ()
    left_out: tuple[str, ...] = ()

    def kinematics(self) -> Kinematics[SceneJoint]:
        """Return the kinematics of the scene."""
        return Kinematics({link.name: link.pose for link in self.links}, self.joints)
