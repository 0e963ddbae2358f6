"""Shapes of a link: their poses, masses and volumes."""

import math
from collections.abc import Iterator
from typing import Literal, NamedTuple

from twinform.diagnostics import Location
from twinform.ir import Collision, Inertial, Link, Mesh, Model, Node, Pose, Shape, Visual
from twinform.ir.bounds import Bounds, bounds, placed_bounds, united
from twinform.ir.defaults import DENSITY, sizes
from twinform.ir.frames import FrameGraph
from twinform.ir.geometry import Box, Capsule, Cone, Cylinder, Ellipsoid, Sphere
from twinform.ir.solids import ORIGIN, Solid, placed, solid, with_tensor
from twinform.ir.transform import Transform
from twinform.passes.analyses.mesh_solids import MeshError, Meshes

Kind = Literal["collision", "visual", "either"]


_EXTENDED = (Box, Capsule, Cone, Cylinder, Ellipsoid, Sphere)
"""Shapes whose sizes are all above zero."""


def is_flat(holder: Visual | Collision) -> bool:
    """Whether a shape has a size that is zero, negative or no number; sizes that are not written are SDF's."""
    shape = holder.geometry.shape if holder.geometry else None
    return isinstance(shape, _EXTENDED) and not all(size > 0 and math.isfinite(size) for size in sizes(shape))


class NoSolidError(Exception):
    """Why a shape has no mass of its own, and where it is."""

    def __init__(self, message: str, location: Location, help: str | None = None) -> None:
        super().__init__(message)
        self.location = location
        self.help = help


class PlacedShape(NamedTuple):
    """A shape of a link: the visual or collision that holds it, and where that is in the link frame."""

    holder: Visual | Collision
    shape: Shape | None
    at: Transform

    @property
    def name(self) -> str:
        """How to call it in a message."""
        kind = "collision" if isinstance(self.holder, Collision) else "visual"
        return f"{kind} {self.holder.name!r}" if self.holder.name else f"a {kind}"


class ShapePlaces:
    """Where the shapes of a model's links are; its frames are only looked at where a pose names one."""

    def __init__(self, model: Model) -> None:
        self._model = model
        self._graph: FrameGraph | None = None

    def shapes(self, link: Link, kind: Kind) -> Iterator[PlacedShape]:
        """The shapes of one kind, or of `either`: the collisions, and the visuals where there are none.

        Raises:
            FrameError: a pose names a frame that cannot be resolved.
        """
        holders: tuple[Visual | Collision, ...] = link.visuals if kind == "visual" else link.collisions
        if kind == "either" and not holders:
            holders = link.visuals
        for holder in holders:
            yield PlacedShape(holder, holder.geometry.shape if holder.geometry else None, self._place(link, holder))

    def inertial(self, link: Link) -> Transform:
        """The inertial frame of a link in the link frame.

        Raises:
            FrameError: its pose names a frame that cannot be resolved.
        """
        return self._resolve(link, link.inertial.pose if link.inertial else None)

    def _place(self, link: Link, holder: Visual | Collision) -> Transform:
        return self._resolve(link, holder.pose)

    def _resolve(self, link: Link, pose: Pose | None) -> Transform:
        if pose is None or not pose.relative_to:
            return Transform.from_pose(pose)
        self._graph = self._graph or FrameGraph(self._model)
        return self._graph.resolve(pose, link.name, link.name)


def solid_of(one: PlacedShape, density: float | None, meshes: Meshes) -> Solid:
    """A shape filled evenly, in the link frame: with the density given, else its own, else that of water.

    Raises:
        NoSolidError: the shape has no inside, or its mesh cannot be used.
    """
    own = own_density(one.holder)
    chosen = density if density is not None else DENSITY if own is None else own
    try:
        found = meshes.solid(one.shape, chosen) if isinstance(one.shape, Mesh) else solid(one.shape, chosen)
    except MeshError as error:
        raise NoSolidError(f"{one.name}: {error.message}", one.holder.location, error.help) from error
    if found is None:
        what = f"a {one.shape.kind}" if one.shape else "no shape"
        raise NoSolidError(f"{one.name} is {what}, of which no volume is known", one.holder.location)
    return placed(found, one.at)


def bounds_of(one: PlacedShape, meshes: Meshes | None) -> Bounds | None:
    """The box around a shape in the link frame; None where it has no ends, or is a mesh and no meshes are looked into.

    Raises:
        NoSolidError: its mesh cannot be read.
    """
    if not isinstance(one.shape, Mesh):
        box = bounds(one.shape)
    elif meshes is None:
        return None
    else:
        try:
            box = Bounds(*meshes.bounds(one.shape))
        except MeshError as error:
            raise NoSolidError(f"{one.name}: {error.message}", one.holder.location, error.help) from error
    return placed_bounds(box, one.at) if box else None


def united_bounds(boxes: list[Bounds | None]) -> Bounds | None:
    """The box around all; None where one of them is not known."""
    known = [box for box in boxes if box is not None]
    return united(known) if len(known) == len(boxes) else None


def own_density(node: Node) -> float | None:
    """The `<density>` of a node; the last one, should there be several."""
    texts = [part.element.text for part in node.opaque if part.element and part.element.name == "density"]
    return float(texts[-1] or "nan") if texts else None


def inertial_of(found: Solid, written: Inertial | None) -> Inertial:
    """An inertial with the numbers of a solid in the link frame; what else is written in the old one stays."""
    return (written or Inertial()).copy(
        auto=None,
        mass=found.mass,
        pose=Pose(xyz=found.center, rpy=ORIGIN) if any(found.center) else None,
        inertia=with_tensor(None, found.inertia),
    )
