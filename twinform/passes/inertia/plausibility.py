"""Masses and inertias against the shapes of their links: what no body within them can have, or hardly any has."""

import math
from collections.abc import Iterable
from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.diagnostics.rules import UNREADABLE_MESH
from twinform.ir import Inertial, Link, Node
from twinform.ir.bounds import Bounds
from twinform.ir.frames import FrameError
from twinform.ir.solids import ORIGIN, Solid, Symmetric, combined, placed
from twinform.ir.verify.verify_bodies import inertia_matrix
from twinform.passes.framework.assets import NO_ASSETS
from twinform.passes.inertia.physical_consistency import has_mass
from twinform.passes.shared.link_shapes import (
    NoSolidError,
    PlacedShape,
    ShapePlaces,
    bounds_of,
    solid_of,
    united_bounds,
)
from twinform.passes.shared.mesh_solids import Meshes

# How far a mass may reach out of its shapes, relative to their size: shapes are drawn by eye.
_SLACK = 0.01
_AXES = "xyz"
_NO_MESHES = Meshes(NO_ASSETS)


class Room(NamedTuple):
    """How far masses may be off their shapes, and how large and small inertias may be.

    Attributes:
        sizes: how far a center of mass may be outside, in sizes of the shapes.
        meters: how far it may be outside whatever the size is, m.
        most: how many times as large an inertia may be as the largest that is possible.
        least: how small it may be, as a part of that of the box around the shapes, filled evenly.
    """

    sizes: float = _SLACK
    meters: float = 0.0
    most: float = 1.0
    least: float = 0.0


_NO_ROOM = Room()


@dataclass(slots=True)
class PlausibilityCheck:
    """Compares masses and inertias of links of one model with their shapes; without `meshes`, meshes are left out."""

    places: ShapePlaces
    meshes: Meshes | None
    densities: tuple[float, float]
    default_moment: float | None
    sink: DiagnosticSink
    room: Room = _NO_ROOM

    def link(self, link: Link, inertial: Inertial) -> None:
        """Report a mass or inertia that the shapes of a link cannot have."""
        matrix = inertia_matrix(inertial.inertia, self.default_moment)
        if not has_mass(inertial) or matrix is None or not all(map(math.isfinite, matrix)):
            return
        try:
            shapes = (*self.places.shapes(link, "collision"), *self.places.shapes(link, "visual"))
            body = placed(Solid(inertial.mass or 0.0, ORIGIN, matrix), self.places.inertial(link))
            box = united_bounds([self.bounds_of(one) for one in shapes])
            if box is None:
                return
            self._check_center(link, inertial, body, box)
            self._check_reach(link, inertial, body, box)
            self.check_density(link, inertial, tuple(self.places.shapes(link, "either")))
        except FrameError:
            return  # its name is only known in an include that was not read
        except NoSolidError as error:
            self.sink.report(UNREADABLE_MESH, str(error), error.location, help=error.help)

    def bounds_of(self, one: PlacedShape) -> Bounds | None:
        """The box around a shape in the link frame, if it has one that is known.

        Raises:
            NoSolidError: its mesh cannot be read.
        """
        return bounds_of(one, self.meshes)

    def _check_center(self, link: Link, inertial: Inertial, body: Solid, box: Bounds) -> None:
        outside = box.distance(body.center)
        if outside > max(self.room.sizes * max(box.size), self.room.meters):
            at = " ".join(f"{part:.4g}" for part in body.center)
            message = f"the center of mass of link {link.name!r}, {at}, is {outside:.4g} m outside of its shapes"
            where = _place(inertial.pose, inertial)
            self.sink.report(rules.DISTANT_CENTRE_OF_MASS, message, where, found=at, expected=_format_box(box))

    def _check_reach(self, link: Link, inertial: Inertial, body: Solid, box: Bounds) -> None:
        size = box.size
        slack = _SLACK * max(size)
        # The second moment of a mass within a length L is at most m (L/2)^2: all of it at both
        # ends.
        reaches = ((length + 2 * slack) / 2 for length in size)
        most = (reach * reach * body.mass for reach in reaches)
        spread = zip(_second_moments(body.inertia), most, _AXES, strict=True)
        factor, axis = max((found / limit if limit else 0.0, axis) for found, limit, axis in spread)
        if factor > self.room.most:
            message = (
                f"the inertia of link {link.name!r} is too large for its shapes along {axis}: "
                f"{factor:.3g} times what {body.mass:.4g} kg within them can have"
            )
            found, expected = f"{factor:.3g}", "at most 1"
            where = _place(inertial.inertia, inertial)
            self.sink.report(rules.OVERSIZED_INERTIA, message, where, found=found, expected=expected)
        even = sum(length * length for length in size) / 12 * body.mass
        part = sum(_second_moments(body.inertia)) / even if even else 1.0
        if 0 < part < self.room.least:
            message = (
                f"the inertia of link {link.name!r} is too small for its shapes: "
                f"{part:.2g} times that of {body.mass:.4g} kg that fill them evenly"
            )
            where, expected = _place(inertial.inertia, inertial), f"at least {self.room.least:g}"
            self.sink.report(rules.UNDERSIZED_INERTIA, message, where, found=f"{part:.2g}", expected=expected)

    def check_density(self, link: Link, inertial: Inertial, shapes: Iterable[PlacedShape]) -> None:
        """Report a mass that is not likely in the volume of the shapes."""
        try:
            volume = combined([solid_of(one, 1.0, self.meshes or _NO_MESHES) for one in shapes]).mass
        except NoSolidError:
            return  # an open mesh has no volume, and what simulators do does not depend on it
        least, greatest = self.densities
        density = (inertial.mass or 0.0) / volume if volume > 0 else least
        if not least <= density <= greatest:
            found, expected = f"{density:.3g}", f"{least:g} to {greatest:g}"
            message = f"link {link.name!r} weighs {inertial.mass:g} kg: {found} kg/m^3 in the volume of its shapes"
            where = inertial.location.at("mass")
            self.sink.report(rules.IMPLAUSIBLE_DENSITY, message, where, found=found, expected=expected)


def _place(part: Node | None, inertial: Inertial) -> Location:
    """Where a part of an `<inertial>` is written; the whole of it where a pass has made the part."""
    return part.location if part is not None and part.source else inertial.location


def _second_moments(inertia: Symmetric) -> tuple[float, float, float]:
    """The second moments of the mass about its center along x, y and z, in kg m^2."""
    xx, yy, zz, *_ = inertia
    x, y, z = xx / 2, yy / 2, zz / 2  # halved first: the sum of two may be no double
    return y + z - x, x + z - y, x + y - z


def _format_box(box: Bounds) -> str:
    sides = zip(_AXES, box.least, box.greatest, strict=True)
    return ", ".join(f"{axis} from {low:.4g} to {high:.4g}" for axis, low, high in sides)
