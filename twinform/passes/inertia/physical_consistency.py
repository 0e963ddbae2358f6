"""Physical consistency of inertias: whether a body can have an inertia, and the nearest one that a body can have.

An inertia I belongs to a body if its second moments of mass S = tr(I)/2 - I are positive definite, which implies both
the triangle inequality and positive moments: P. Wensing, S. Kim and J.-J. Slotine 2018, "Linear matrix inequalities for
physically-consistent inertial parameter identification", IEEE Robotics and Automation Letters 3(1). These inertias are
a convex cone that depends only on the principal moments, so the nearest one (by the sum of the squares of all nine
elements) has the same axes, and its moments are the nearest three numbers in a cone with three sides: A. Lewis 1996,
"Convex analysis on the Hermitian matrices", SIAM Journal on Optimization 6(1).

An inertia is plausible if a body within the shapes of its link can have it.
"""

import math
from collections.abc import Iterable
from typing import NamedTuple

from twinform.dataclass import dataclass
from twinform.diagnostics import DiagnosticSink, Location, rules
from twinform.diagnostics.rules import UNREADABLE_MESH
from twinform.ir import Format, Inertial, Link, Node
from twinform.ir.bounds import Bounds
from twinform.ir.defaults import MOMENT
from twinform.ir.frames import FrameError
from twinform.ir.solids import (
    ORIGIN,
    Axes,
    Solid,
    Symmetric,
    combined,
    placed,
    principal_axes,
    relative_moments,
    times_each,
)
from twinform.ir.transform import common_exponent
from twinform.ir.verify.verify_bodies import inertia_matrix
from twinform.passes.framework.assets import NO_ASSETS
from twinform.passes.shared.link_shapes import (
    NoSolidError,
    PlacedShape,
    ShapePlaces,
    bounds_of,
    solid_of,
    united_bounds,
)
from twinform.passes.shared.mesh_solids import Meshes

ROUNDING = 1e-15
"""The error of a moment that is exactly zero after ten operations on doubles, as a fraction of the trace."""
FOUND_AXES = 1e-8
"""The error of libsdformat when it computes principal axes, as a fraction of the largest moment: of two equal roots of
the cubic equation half of the digits are lost. Other programs lose less."""
DIGITS = 1e-6
"""The error of moments in files that have few digits, as a fraction of the trace."""


def has_mass(inertial: Inertial | None) -> bool:
    """Whether a mass is written that a body can have."""
    return inertial is not None and inertial.mass is not None and 0 < inertial.mass < math.inf


def is_possible(inertial: Inertial, format_: Format) -> bool:
    """Whether a body can have this mass and inertia, if the few digits of files are taken into account."""
    matrix = inertia_matrix(inertial.inertia, MOMENT[format_])
    if not has_mass(inertial) or matrix is None or not all(map(math.isfinite, matrix)):
        return False
    smallest, middle, largest = relative_moments(matrix)
    trace = abs(smallest + middle + largest)
    return smallest > ROUNDING * trace and largest - smallest - middle <= DIGITS * trace


def clearances(matrix: Symmetric) -> tuple[float, float]:
    """The smallest principal moment, and the sum of the two smaller ones minus the largest, relative to the largest.

    If one of them is negative, no body has the inertia. All elements have to be finite.
    """
    smallest, middle, largest = relative_moments(matrix)
    size = abs(largest) or 1.0
    return smallest / size, (smallest + middle - largest) / size


def rounding_loss(matrix: Symmetric) -> float:
    """By how much programs may err in the clearances: nothing if they need not compute the axes."""
    return FOUND_AXES if any(matrix[3:]) else 0.0


def is_clearly_possible(matrix: Symmetric) -> bool:
    """Whether a body can have this inertia, and every engine agrees; none has one that is not finite."""
    if not all(map(math.isfinite, matrix)):
        return False
    smallest, gap = clearances(matrix)
    lost = rounding_loss(matrix)
    return smallest > lost and gap >= lost


def is_doubtful(matrix: Symmetric) -> bool:
    """Whether rounding decides if an engine finds that a body can have this inertia."""
    return any(matrix[3:]) and abs(min(clearances(matrix))) <= rounding_loss(matrix)


Moments = tuple[float, float, float]


def nearest_possible(matrix: Symmetric, floor: float) -> Symmetric:
    """The nearest inertia whose second moments of mass are all at least `floor`, which is finite, in kg m^2.

    Elements that overflow are infinite.
    """
    exponent = common_exponent((*matrix, floor))
    moments, axes = principal_axes(times_each(matrix, -exponent))
    return times_each(_compose(nearest_moments(moments, math.ldexp(floor, -exponent)), axes), exponent)


def nearest_moments(moments: Moments, floor: float) -> Moments:
    """The principal moments of the nearest inertia, in the same order.

    A body with second moments f along all axes has the moments 2f: subtracting these leaves a cone with its tip at
    zero.
    """
    order = sorted(range(3), key=lambda axis: moments[axis])
    smallest, middle, largest = (moments[axis] - 2 * floor for axis in order)
    found = [0.0, 0.0, 0.0]
    for axis, value in zip(order, _project_onto_cone(smallest, middle, largest), strict=True):
        found[axis] = value + 2 * floor
    return found[0], found[1], found[2]


def _project_onto_cone(smallest: float, middle: float, largest: float) -> Moments:
    """The nearest to three sorted moments of which none is greater than the sum of the others."""
    # Three cases in closed form. A test holds the result to the inequality that defines a
    # projection onto a convex set.
    excess = largest - smallest - middle
    if excess <= 0 <= smallest:
        return smallest, middle, largest
    if smallest + excess / 3 >= 0 < excess:  # onto the side where the largest is the sum of the others
        low = smallest + excess / 3
        high = max(middle + excess / 3, low)  # which rounding can deny
        return low, high, low + high
    edge = max((middle + largest) / 2, 0.0)  # onto the edge where the smallest is zero: a rod without thickness
    return 0.0, edge, edge


def second_moments(moments: Moments) -> Moments:
    """The second moments of mass along three axes, in kg m^2, of the moments about them: how far the mass spreads."""
    x, y, z = (moment / 2 for moment in moments)  # halved first: the sum of two may be no double
    return y + z - x, x + z - y, x + y - z


def distance(one: Symmetric, other: Symmetric) -> float:
    """The root of the sum of the squared differences of all nine elements, in kg m^2."""
    gaps = [a - b for a, b in zip(one, other, strict=True)]
    return math.hypot(*gaps, *gaps[3:])


def _compose(moments: Moments, axes: Axes) -> Symmetric:
    """The matrix with these moments about these axes."""

    def entry(i: int, j: int) -> float:
        return math.fsum(moment * axis[i] * axis[j] for moment, axis in zip(moments, axes, strict=True)) + 0.0

    return entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)


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
        felt: the sum of moments below which an inertia is never too large, kg m^2.
    """

    sizes: float = _SLACK
    meters: float = 0.0
    most: float = 1.0
    least: float = 0.0
    felt: float = 0.0


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
        spread = zip(second_moments(body.inertia[:3]), most, _AXES, strict=True)
        factor, axis = max((found / limit if limit else 0.0, axis) for found, limit, axis in spread)
        if factor > self.room.most and sum(body.inertia[:3]) >= self.room.felt:
            message = (
                f"the inertia of link {link.name!r} is too large for its shapes along {axis}: "
                f"{factor:.3g} times what {body.mass:.4g} kg within them can have"
            )
            found, expected = f"{factor:.3g}", "at most 1"
            where = _place(inertial.inertia, inertial)
            self.sink.report(rules.OVERSIZED_INERTIA, message, where, found=found, expected=expected)
        even = sum(length * length for length in size) / 12 * body.mass
        part = sum(second_moments(body.inertia[:3])) / even if even else 1.0
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


def _format_box(box: Bounds) -> str:
    sides = zip(_AXES, box.least, box.greatest, strict=True)
    return ", ".join(f"{axis} from {low:.4g} to {high:.4g}" for axis, low, high in sides)
