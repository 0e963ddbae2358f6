"""A robot as it is compared: bodies, joints and frames, all in the model's frame with every joint at zero."""

from collections.abc import Mapping
from dataclasses import field

from twinform.compiler.compare.compared_values import Value
from twinform.compiler.kinematics import PlacedJoint
from twinform.dataclass import dataclass
from twinform.diagnostics import Source
from twinform.ir import Format, Vector3
from twinform.ir.solids import NOTHING, Solid
from twinform.ir.transform import Transform


@dataclass(frozen=True, slots=True)
class Leaf:
    """A value, and the default that stands for it where it is not written.

    `only` is the format that alone has an element for it, if there is one. A `carried` value is only read by twinform.
    """

    value: Value
    default: Value | None = None
    where: Source | None = None
    only: Format | None = None
    carried: bool = False


Leaves = Mapping[str, Leaf]
"""Values by their path, such as `geometry/box/size`."""


@dataclass(frozen=True, slots=True)
class LinkPart:
    """A visual, collision, sensor, light, plugin or other part of a link, joint, model or world."""

    kind: str
    name: str
    leaves: Leaves
    where: Source | None = None
    only: Format | None = None
    carried: bool = False


@dataclass(frozen=True, slots=True)
class Mass:
    """The mass and inertia of a body in the model's frame; an automatic one is computed by the reader."""

    solid: Solid = NOTHING
    automatic: bool = False
    where: Source | None = None


@dataclass(frozen=True, slots=True)
class ComparedBody:
    """A link with its frame."""

    name: str
    frame: Transform
    mass: Mass
    leaves: Leaves = field(default_factory=dict[str, Leaf])
    parts: tuple[LinkPart, ...] = ()
    where: Source | None = None


@dataclass(frozen=True, slots=True)
class JointView(PlacedJoint):
    """A joint between two bodies, or the world."""

    leaves: Leaves = field(default_factory=dict[str, Leaf])
    parts: tuple[LinkPart, ...] = ()
    where: Source | None = None

    @property
    def axes(self) -> tuple[Vector3, ...]:
        """The axes as unit vectors; a ball joint has none."""
        return () if self.type == "ball" else tuple(degree.axis for degree in self.degrees)


@dataclass(frozen=True, slots=True)
class NamedFrame:
    """A frame that moves with a body.

    `was_link` and `was_joint` say that URDF has a massless link in its place, or the joint of one. A `lumped` frame is
    what is left of a link that was merged into another one, or of its joint.
    """

    name: str
    body: str
    pose: Transform
    was_link: bool = False
    was_joint: bool = False
    lumped: bool = False
    where: Source | None = None


@dataclass(frozen=True, slots=True)
class ComparedRobot:
    """A model; `world` is the frame of the world in the model's frame, and `models` are the names of nested models.

    One `of_usd` comes from a USD file, in the terms of SDF.
    """

    name: str
    format: Format
    world: Transform
    bodies: Mapping[str, ComparedBody]
    joints: Mapping[str, JointView]
    frames: Mapping[str, NamedFrame]
    models: frozenset[str] = frozenset()
    leaves: Leaves = field(default_factory=dict[str, Leaf])
    parts: tuple[LinkPart, ...] = ()
    where: Source | None = None
    of_usd: bool = False
