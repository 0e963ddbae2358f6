"""Inertias with `auto` in SDF, computed from the collisions as SDF readers do."""

from collections.abc import Callable, Iterable

from twinform.diagnostics import Location
from twinform.ir import Collision, Inertial, Link, Mesh, Model, Opaque
from twinform.ir.defaults import DENSITY
from twinform.ir.frames import FrameGraph
from twinform.ir.solids import Solid, combined, placed, solid, with_mass
from twinform.passes.analyses.link_shapes import inertial_of, own_density
from twinform.passes.analyses.mesh_solids import MeshError, Meshes
from twinform.passes.carriers.carriers import to_element

COMPUTED_MASS = "computed-mass"
"""The annotation on an inertial whose mass was computed with its inertia: `<tf:computed-mass/>`."""


class NoInertiaError(Exception):
    """Why an inertia cannot be computed, and where the cause is."""

    def __init__(self, message: str, location: Location, help: str | None = None) -> None:
        super().__init__(message)
        self.location = location
        self.help = help


def map_automatic(model: Model, write: Callable[[Link, Inertial, FrameGraph], Link]) -> Model:
    """The model with each link written anew whose inertia is left to the reader."""
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

    Every collision is filled with its own `<density>`, else with that of the inertial, else with water. A mass that is
    written stays: the inertia is scaled to it. Other readers agree: libsdformat, Link::ResolveAutoInertials.

    Raises:
        NoInertiaError: there is no collision, or one of a shape without an inside, or of a mesh that is not found.
        FrameError: a collision is posed in a frame that is not known.
    """
    # The order of libsdformat (Link::ResolveAutoInertials): the collision's own <density>, then
    # that of the inertial, then 1000 kg/m^3.
    usual = own_density(inertial)
    parts = [_filled(link, one, usual, graph, meshes) for one in collisions]
    if not parts:
        raise NoInertiaError(f"link {link.name!r} has no collision to compute its inertia from", inertial.location)
    whole = combined(parts)
    return whole if inertial.mass is None else with_mass(whole, inertial.mass)


def written_out(inertial: Inertial, found: Solid) -> tuple[Inertial, list[Opaque], tuple[str, ...]]:
    """An automatic inertial with the numbers of what was found.

    With it, as pieces of SDF, that it was automatic, and the pose and inertia that readers of SDF overlook; and the
    names of the fields that are computed.
    """
    # A pose or inertia that is written beside auto="true" is ignored by readers of SDF. It travels
    # all the same, so that the file comes back as it was.
    overlooked = to_element(inertial.copy(mass=None, opaque=()), "inertial", "sdf")
    pieces = [Opaque.unchecked(attribute=pair) for pair in overlooked.attributes]
    pieces += [Opaque.unchecked(element=child) for child in overlooked.children]
    made = ("pose", "inertia") if inertial.mass is not None else ("mass", "pose", "inertia")
    return inertial_of(found, inertial), pieces, made


def _filled(link: Link, collision: Collision, usual: float | None, graph: FrameGraph, meshes: Meshes) -> Solid:
    shape = collision.geometry.shape if collision.geometry else None
    own = own_density(collision)
    density = own if own is not None else DENSITY if usual is None else usual
    computed = f"the inertia of link {link.name!r} is computed from collision {collision.name!r}"
    try:
        filled = meshes.solid(shape, density) if isinstance(shape, Mesh) else solid(shape, density)
    except MeshError as error:
        raise NoInertiaError(f"{computed}: {error.message}", collision.location, error.help) from error
    if filled is None:
        what = f"a {shape.kind}" if shape else "no shape"
        raise NoInertiaError(f"{computed}, which is {what}", collision.location)
    return placed(filled, graph.resolve(collision.pose, link.name, link.name))
