"""Plausibility of the mass and inertia of a link, compared with its shapes."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from twinform.diagnostics import DiagnosticSink, rules
from twinform.diagnostics.rules import UNREADABLE_MESH
from twinform.ir import Inertial, Link
from twinform.ir.bounds import Bounds
from twinform.ir.frames import FrameError
from twinform.ir.principal_moments import Symmetric
from twinform.ir.solids import ORIGIN, Solid, combined, placed
from twinform.ir.verify.verify_bodies import inertia_matrix
from twinform.passes.analyses.link_shapes import (
    NoSolidError,
    PlacedShape,
    ShapePlaces,
    bounds_of,
    solid_of,
    united_bounds,
)
from twinform.passes.analyses.mesh_solids import Meshes
from twinform.passes.framework.assets import NO_ASSETS
from twinform.passes.inertia.physical_consistency import has_mass

# How far a mass may reach out of its shapes, relative to their size: shapes are drawn by eye.
_SLACK = 0.01
_AXES = "xyz"
_NO_MESHES = Meshes(NO_ASSETS)


@dataclass(frozen=True, slots=True)
class Plausible:
    """The checks for the links of one model. Without `meshes`, links that have a mesh are left out."""

    places: ShapePlaces
    meshes: Meshes | None
    densities: tuple[float, float]
    default_moment: float | None
    sink: DiagnosticSink

    def link(self, link: Link, inertial: Inertial) -> None:
        """Report what does not go together."""
        matrix = inertia_matrix(inertial.inertia, self.default_moment)
        if not has_mass(inertial) or matrix is None or not all(map(math.isfinite, matrix)):
            return
        try:
            shapes = (*self.places.shapes(link, "collision"), *self.places.shapes(link, "visual"))
            body = placed(Solid(inertial.mass or 0.0, ORIGIN, matrix), self.places.inertial(link))
            box = united_bounds([bounds_of(one, self.meshes) for one in shapes])
            if box is None:
                return
            self._check_reach(link, inertial, body, box)
            self._check_density(link, inertial, tuple(self.places.shapes(link, "either")))
        except FrameError:
            return  # its name is only known in an include that was not read
        except NoSolidError as error:
            self.sink.report(UNREADABLE_MESH, str(error), error.location, help=error.help)

    def _check_reach(self, link: Link, inertial: Inertial, body: Solid, box: Bounds) -> None:
        size = box.size
        slack = _SLACK * max(size)
        outside = box.distance(body.center)
        if outside > slack:
            at = " ".join(f"{part:.4g}" for part in body.center)
            message = f"the center of mass of link {link.name!r}, {at}, is {outside:.4g} m outside of its shapes"
            self.sink.report(rules.DISTANT_CENTRE_OF_MASS, message, inertial.location, found=at, expected=_words(box))
        # The second moment of a mass within a length L is at most m (L/2)^2: all of it at both
        # ends.
        reaches = ((length + 2 * slack) / 2 for length in size)
        most = (reach * reach * body.mass for reach in reaches)
        spread = zip(_spread(body.inertia), most, _AXES, strict=True)
        factor, axis = max((found / limit if limit else 0.0, axis) for found, limit, axis in spread)
        if factor > 1:
            message = (
                f"the inertia of link {link.name!r} is too large for its shapes along {axis}: "
                f"{factor:.3g} times what {body.mass:.4g} kg within them can have"
            )
            found, expected = f"{factor:.3g}", "at most 1"
            self.sink.report(rules.OVERSIZED_INERTIA, message, inertial.location, found=found, expected=expected)

    def _check_density(self, link: Link, inertial: Inertial, shapes: Iterable[PlacedShape]) -> None:
        try:
            volume = combined([solid_of(one, 1.0, self.meshes or _NO_MESHES) for one in shapes]).mass
        except NoSolidError:
            return  # an open mesh has no volume, and what simulators do does not depend on it
        least, greatest = self.densities
        density = (inertial.mass or 0.0) / volume if volume > 0 else least
        if not least <= density <= greatest:
            found, expected = f"{density:.3g}", f"{least:g} to {greatest:g}"
            message = f"link {link.name!r} weighs {inertial.mass:g} kg: {found} kg/m^3 in the volume of its shapes"
            self.sink.report(rules.IMPLAUSIBLE_DENSITY, message, inertial.location, found=found, expected=expected)


def _spread(inertia: Symmetric) -> tuple[float, float, float]:
    """The second moments of the mass about its center along x, y and z, in kg m^2."""
    xx, yy, zz, *_ = inertia
    x, y, z = xx / 2, yy / 2, zz / 2  # halved first: the sum of two may be no double
    return y + z - x, x + z - y, x + y - z


def _words(box: Bounds) -> str:
    sides = zip(_AXES, box.least, box.greatest, strict=True)
    return ", ".join(f"{axis} from {low:.4g} to {high:.4g}" for axis, low, high in sides)
