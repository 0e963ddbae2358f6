"""Shapes and bodies of links: poses, bounds, masses, and inertias that SDF readers compute from collisions."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Literal, NamedTuple

from twinform.diagnostics import DiagnosticSink, Location, Severity
from twinform.diagnostics.rules import INDEFINITE_INERTIA
from twinform.ir import Collision, Format, Inertial, Link, Mesh, Model, Node, Opaque, Pose, Shape, Visual
from twinform.ir.bounds import Bounds, bounds, placed_bounds, united
from twinform.ir.defaults import DENSITY, sizes
from twinform.ir.frames import FrameGraph
from twinform.ir.geometry import Box, Capsule, Cone, Cylinder, Ellipsoid, Sphere
from twinform.ir.solids import ORIGIN, Solid, combined, placed, solid, turned, with_mass, with_tensor, written_solid
from twinform.ir.transform import Transform
from twinform.passes.carriers.carriers import to_element
from twinform.passes.framework.assets import NO_ASSETS
from twinform.passes.shared.mesh_solids import MeshError, Meshes

Kind = Literal["collision", "visual", "either"]
_EXTENDED = (Box, Capsule, Cone, Cylinder, Ellipsoid, Sphere)
"""Shapes whose sizes are all above zero."""
COMPUTED_MASS = "computed-mass"
"""The annotation on an inertial whose mass was computed with its inertia: `<tf:computed-mass/>`."""


def is_flat(holder: Visual | Collision) -> bool:
    """Whether a shape has a size that is zero, negative or not a number; an absent size is SDF's default."""
    shape = holder.geometry.shape if holder.geometry else None
    return isinstance(shape, _EXTENDED) and not all(size > 0 and math.isfinite(size) for size in sizes(shape))


class NoSolidError(Exception):
    """A shape or link has no mass or inertia that can be computed; `location` is the cause."""

    def __init__(self, message: str, location: Location, help: str | None = None) -> None:
        super().__init__(message)
        self.location = location
        self.help = help


class PlacedShape(NamedTuple):
    """A shape of a link, the visual or collision that holds it, and its place in the link frame."""

    holder: Visual | Collision
    shape: Shape | None
    at: Transform

    @property
    def name(self) -> str:
        """The visual or collision as a message names it."""
        kind = "collision" if isinstance(self.holder, Collision) else "visual"
        return f"{kind} {self.holder.name!r}" if self.holder.name else f"a {kind}"


class ShapePlaces:
    """Finds the places of shapes in their links; the frame graph is only built where a pose names a frame."""

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
    """The box around all boxes; None where one of them is not known."""
    known = [box for box in boxes if box is not None]
    return united(known) if len(known) == len(boxes) else None


def map_automatic(model: Model, write: Callable[[Link, Inertial, FrameGraph], Link]) -> Model:
    """The model with `write` applied to each link that has an automatic inertia."""
    if not any(link.inertial and link.inertial.auto for link in model.links):
        return model
    graph = FrameGraph(model)
    links = (
        write(link, link.inertial, graph) if link.inertial and link.inertial.auto else link for link in model.links
    )
    return model.copy(links=tuple(links))


def automatic(
    link: Link, inertial: Inertial, collisions: Iterable[Collision], graph: FrameGraph, meshes: Meshes
) -> Solid:
    """The mass, center and inertia of a link in its own frame.

    Every collision is filled evenly. A written mass stays, and the inertia is scaled to it.

    Raises:
        NoSolidError: there is no collision, or one of a shape without an inside, or of a mesh that is not found.
        FrameError: a collision is posed in a frame that is not known.
    """
    # The order of libsdformat (Link::ResolveAutoInertials): the collision's own <density>, then
    # that of the inertial, then 1000 kg/m^3.
    usual = own_density(inertial)
    parts = [_fill(link, one, usual, graph, meshes) for one in collisions]
    if not parts:
        raise NoSolidError(f"link {link.name!r} has no collision to compute its inertia from", inertial.location)
    whole = combined(parts)
    return whole if inertial.mass is None else with_mass(whole, inertial.mass)


def written_out(inertial: Inertial, found: Solid) -> tuple[Inertial, list[Opaque], tuple[str, ...]]:
    """The automatic inertial with the computed numbers, carrier pieces, and the names of the computed fields.

    The pieces are the attribute `auto`, and a written pose and inertia, which readers of SDF overlook.
    """
    # A pose or inertia that is written beside auto="true" is ignored by readers of SDF. It travels
    # all the same, so that the file comes back as it was.
    overlooked = to_element(inertial.copy(mass=None, opaque=()), "inertial", "sdf")
    pieces = [Opaque.unchecked(attribute=pair) for pair in overlooked.attributes]
    pieces += [Opaque.unchecked(element=child) for child in overlooked.children]
    made = ("pose", "inertia") if inertial.mass is not None else ("mass", "pose", "inertia")
    return inertial_of(found, inertial), pieces, made


def _fill(link: Link, collision: Collision, usual: float | None, graph: FrameGraph, meshes: Meshes) -> Solid:
    """A collision filled evenly, in the link frame; `usual` is the density of the inertial."""
    shape = collision.geometry.shape if collision.geometry else None
    own = own_density(collision)
    density = own if own is not None else DENSITY if usual is None else usual
    computed = f"the inertia of link {link.name!r} is computed from collision {collision.name!r}"
    try:
        filled = meshes.solid(shape, density) if isinstance(shape, Mesh) else solid(shape, density)
    except MeshError as error:
        raise NoSolidError(f"{computed}: {error.message}", collision.location, error.help) from error
    if filled is None:
        what = f"a {shape.kind}" if shape else "no shape"
        raise NoSolidError(f"{computed}, which is {what}", collision.location)
    return placed(filled, graph.resolve(collision.pose, link.name, link.name))


def own_density(node: Node) -> float | None:
    """The last `<density>` of a node."""
    texts = [part.element.text for part in node.opaque if part.element and part.element.name == "density"]
    return float(texts[-1] or "nan") if texts else None


def inertial_of(found: Solid, written: Inertial | None) -> Inertial:
    """The inertial with the mass, center and inertia of a solid in the link frame."""
    return (written or Inertial.unchecked()).copy(
        auto=None,
        mass=found.mass,
        pose=Pose.unchecked(xyz=found.center, rpy=ORIGIN) if any(found.center) else None,
        inertia=with_tensor(None, found.inertia),
    )


_NO_MESHES = Meshes(NO_ASSETS)
"""By default no inertia is computed from a mesh; `fill-inertia` does that."""


def body_of(link: Link, graph: FrameGraph, format_: Format, meshes: Meshes = _NO_MESHES) -> Solid:
    """The mass, center and inertia of a link in its own frame, with the defaults of the format.

    `meshes` has the mesh files that an automatic inertia is computed from.

    Raises:
        NoSolidError: the inertia is automatic and cannot be computed.
        FrameError: a pose is in an unknown frame.
    """
    inertial = link.inertial
    if inertial is None:
        return written_solid(None, format_)
    if inertial.auto:
        return automatic(link, inertial, link.collisions, graph, meshes)
    return placed(written_solid(inertial, format_), graph.resolve(inertial.pose, link.name, link.name))


def add_guests(link: Link, own: Solid, guests: Sequence[Solid], sink: DiagnosticSink) -> Link:
    """The link with the mass of other solids in its frame; the axes of its inertia stay as they are written.

    A result that overflows is reported as an error.
    """
    heavy = [guest for guest in guests if guest.mass]
    if not heavy:
        return link
    whole = combined([own, *heavy])
    if not all(map(math.isfinite, (whole.mass, *whole.center, *whole.inertia))):
        message = (
            f"the mass and inertia of link {link.name!r} with all that is lumped into it are too large for a double"
        )
        sink.report(INDEFINITE_INERTIA, message, link.location, severity=Severity.ERROR)
        return link
    return link.copy(inertial=write_solid(link.inertial or Inertial.unchecked(), whole))


def write_solid(inertial: Inertial, whole: Solid) -> Inertial:
    """The inertial with the values of a solid in the frame of its link; the axes of the inertia stay as written."""
    written = None if inertial.auto else inertial.pose
    axes = Transform(rotation=Transform.from_pose(written).rotation)
    return inertial.copy(
        auto=None,
        mass=whole.mass,
        pose=_pose_at_center(written, whole),
        inertia=with_tensor(inertial.inertia, turned(whole.inertia, axes.inverse())),
    )


def _pose_at_center(written: Pose | None, whole: Solid) -> Pose:
    """The pose of an inertial with another center of mass, in the frame of the link."""
    pose = written or Pose.unchecked(rpy=(0.0, 0.0, 0.0))
    return pose.copy(xyz=whole.center, relative_to=None)
