"""Check that bodies which move have a mass and an inertia that a body can have."""

from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import Notes, Severity
from twinform.diagnostics.rules.inertia import MISSING_INERTIAL, NON_POSITIVE_MASS
from twinform.ir import Document, Format, Inertial, Link
from twinform.ir.verify.inertia import inertia_matrix, report_moments
from twinform.passes.base import Pass
from twinform.passes.moving_bodies import moving_bodies

_DEFAULT_MOMENT = {Format.URDF: None, Format.SDF: 1.0}  # URDF has none; the schema reports what is missing there
_ROUNDING = 1e-15
"""What ten operations on doubles leave of a moment that is exactly zero, as a part of the trace."""


class CheckInertia(Pass):
    """Finds masses and inertias that no moving body can have.

    It changes nothing. It reports, at the `<inertial>` of a link, or at the link where it has none:

    1. `missing-inertial`: in URDF a body, that is links held together by fixed joints, of which no link has an
       `<inertial>`; in SDF a link without one;
    2. `non-positive-mass`: a mass of zero or less;
    3. `indefinite-inertia`: a principal moment of zero or less;
    4. `impossible-inertia`: a principal moment that is larger than the sum of the other two.

    It never looks at what cannot move (static models, and links that fixed joints hold to the world), at inertias that
    the simulator computes (`auto`), and at models that an `<include>` names.
    """

    name = "check-inertia"
    example: ClassVar[str] = "check-inertia{eps=0.001}"

    eps: float = Field(
        default=1e-6,
        ge=0,
        lt=1,
        allow_inf_nan=False,
        description="How far the largest principal moment may exceed the sum of the others, as a part of the trace: "
        "files round.",
    )

    def run(self, document: Document, notes: Notes) -> Document:
        """The same document."""
        for body in moving_bodies(document):
            _check_presence(body, document.format, notes)
            for link in body:
                if link.inertial and not link.inertial.auto:
                    _check_inertial(link, link.inertial, document.format, self.eps, notes)
        return document


def _check_presence(body: tuple[Link, ...], format_: Format, notes: Notes) -> None:
    if format_ is Format.SDF:
        for link in body:
            if link.inertial is None:
                message = f"link {link.name!r} moves but has no <inertial>; simulators take 1 kg and 1 kg m^2"
                notes.report(MISSING_INERTIAL, message, link.location, expected="<inertial>")
    elif not any(link.inertial for link in body):
        first, *others = body
        joined = f", nor has any of the {len(others)} fixed to it" if others else ""
        message = f"link {first.name!r} moves but has no <inertial>{joined}"
        related = tuple(link.location for link in others)
        notes.report(MISSING_INERTIAL, message, first.location, expected="<inertial>", related=related)


def _check_inertial(link: Link, inertial: Inertial, format_: Format, eps: float, notes: Notes) -> None:
    mass, matrix = inertial.mass, inertia_matrix(inertial.inertia, _DEFAULT_MOMENT[format_])
    if mass is not None and not mass > 0 and not notes.has(NON_POSITIVE_MASS, inertial.location, Severity.WARNING):
        message = f"the mass of link {link.name!r}, which moves, is {mass:g}; it has to be positive"
        notes.report(NON_POSITIVE_MASS, message, inertial.location, found=f"{mass:g}", expected="more than 0")
    if matrix is not None and (mass != 0 or any(matrix)):
        report_moments(link, inertial, matrix, eps, notes, least=_ROUNDING)
