"""Replace impossible inertias by the nearest that a body can have."""

import math
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import DiagnosticSink, Severity
from twinform.diagnostics.rules import BALANCED_INERTIA, UNBALANCED_INERTIA
from twinform.ir import Document, Format, Inertial, Link, rewrite
from twinform.ir.defaults import MOMENT
from twinform.ir.solids import Symmetric, principal_moments, times_each, with_tensor
from twinform.ir.transform import common_exponent, times_power
from twinform.ir.verify.verify_bodies import inertia_matrix
from twinform.passes.framework.pass_base import EVERY, Pass, matches, with_such_a_name
from twinform.passes.inertia.physical_consistency import distance, has_mass, is_clearly_possible, nearest_possible

# A relative change this small restores digits that were cut off, and is no news.
_NOTHING_MUCH = 1e-3
_NOTHING: Symmetric = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


class BalanceInertia(Pass):
    """Replace inertias that no body can have by the nearest one that a body can have, with the same axes.

    Changes the `<inertia>` of links whose name matches `links`, where

    1. a principal moment is zero or less, or less than `least`;
    2. a principal moment exceeds the sum of the other two, be it by a digit that was cut off: libsdformat refuses that;
    3. in URDF, a link has a mass and no `<inertia>`, which is taken as zero.

    Where the axes of the matrix have to be found, rounding may put a moment on either side of such a bound, in each
    engine on another one: there a moment has to be clear of it. Nearest means the least sum of squared changes of the
    nine elements. So that engines need not divide by zero, the mass is left with some extent along every axis:
    `thickness`, or the part `margin` of the trace if that is more. It runs only where it is asked for: the numbers that
    come out are possible, not measured.

    Never touches: an inertia that is possible, masses, centers of mass, and inertias that the simulator computes.
    Diagnostics: `balanced-inertia` with the change for each link, and `unbalanced-inertia` for links without a positive
    mass and for numbers that are not finite.
    """

    name = "balance-inertia"
    example: ClassVar[str] = "balance-inertia{thickness=0.001}"

    links: tuple[str, ...] = Field(default=EVERY, description=with_such_a_name("Only links"))
    thickness: float = Field(
        default=1e-4,
        ge=0,
        allow_inf_nan=False,
        description="The least root mean square extent of the mass along an axis, in m.",
    )
    margin: float = Field(
        default=1e-6,
        ge=0,
        le=0.1,
        allow_inf_nan=False,
        description="The least second moment of mass along an axis, as a part of the trace: digits are cut off again.",
    )
    least: float = Field(
        default=0.0,
        ge=0,
        le=1e50,
        description="The least principal moment, in kg m^2: MuJoCo takes those below 1e-14 for none.",
    )

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The document with inertias that bodies can have."""

        def balance(link: Link) -> Link:
            inertial = link.inertial
            if inertial is None or inertial.auto or not matches(link.name, self.links):
                return link
            matrix = inertia_matrix(inertial.inertia, MOMENT[document.format])
            # A mass without <inertia> is an inertia of zero to readers of URDF, on which DART
            # aborts.
            if inertial.inertia is None and document.format is Format.URDF and has_mass(inertial):
                matrix = _NOTHING
            return link if matrix is None else self._balance(link, inertial, matrix, sink)

        return rewrite(document, Link, balance)

    def _balance(self, link: Link, inertial: Inertial, matrix: Symmetric, sink: DiagnosticSink) -> Link:
        finite = all(map(math.isfinite, matrix))
        if finite and is_clearly_possible(matrix) and principal_moments(matrix)[0] >= self.least:
            return link
        if not finite or not has_mass(inertial):
            what = "has no positive mass" if finite else "is not finite"
            message = f"the inertia of link {link.name!r} {what}, so there is no nearest possible inertia"
            sink.report(UNBALANCED_INERTIA, message, inertial.location, help="run fill-inertia{replace=impossible}")
            return link
        floor = self._least_second_moment(inertial.mass or 0.0, matrix)
        # MuJoCo's `balanceinertia` sets all three moments to their mean, which also moves those
        # that were right; adding a constant until the triangle inequality holds moves the smallest
        # ones most.
        found = nearest_possible(matrix, floor) if floor < math.inf else None
        if found is None or not all(map(math.isfinite, found)):
            message = f"the inertia that is nearest to that of link {link.name!r} is too large for a double"
            sink.report(UNBALANCED_INERTIA, message, inertial.location)
            return link
        _report_change(link, inertial, matrix, found, sink)
        inertia = with_tensor(inertial.inertia, found)
        return link.copy(inertial=inertial.copy(inertia=inertia))

    def _least_second_moment(self, mass: float, matrix: Symmetric) -> float:
        """The least second moment of mass along an axis, in kg m^2; a principal moment is the sum of two."""
        exponent = common_exponent(matrix)
        trace = abs(sum(times_each(matrix, -exponent)[:3]))
        return max(times_power(self.margin * trace, exponent), mass * self.thickness * self.thickness, self.least / 2)


def _relative_change(old: Symmetric, new: Symmetric) -> float:
    """How large a change is relative to what is changed."""
    exponent = common_exponent((*old, *new)) + 1  # so that no difference overflows
    before, after = times_each(old, -exponent), times_each(new, -exponent)
    size = distance(before, _NOTHING)
    return distance(before, after) / size if size else math.inf


def _report_change(link: Link, inertial: Inertial, old: Symmetric, new: Symmetric, sink: DiagnosticSink) -> None:
    was, now = (", ".join(f"{moment:.6g}" for moment in principal_moments(each)) for each in (old, new))
    part = _relative_change(old, new)
    change = f"by {part:.2g} of its size" if any(old) else "from zero"
    message = f"the inertia of link {link.name!r} is changed {change}: its principal moments were {was} and are {now}"
    severity = Severity.INFO if part < _NOTHING_MUCH else None
    sink.report(BALANCED_INERTIA, message, inertial.location, found=was, expected=now, severity=severity)
