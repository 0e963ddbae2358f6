"""Check that bodies which move have a mass and an inertia that a body can have."""

import math
from typing import ClassVar

from pydantic import Field

from twinform.diagnostics import Notes
from twinform.diagnostics.rules.inertia import (
    IMPOSSIBLE_INERTIA,
    INDEFINITE_INERTIA,
    MISSING_INERTIAL,
    NON_POSITIVE_MASS,
)
from twinform.ir import Document, Format, Inertia, Inertial, Link
from twinform.passes.base import Pass
from twinform.passes.moving_bodies import moving_bodies
from twinform.passes.principal_moments import Symmetric, principal_moments

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
                    _check_inertial(link.name, link.inertial, document.format, self.eps, notes)
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


def _check_inertial(link: str, inertial: Inertial, format_: Format, eps: float, notes: Notes) -> None:
    mass, matrix = inertial.mass, _matrix(inertial.inertia, format_)
    if mass is not None and not mass > 0:  # the negation catches what is not a number
        message = f"the mass of link {link!r} is {mass:g}; it has to be positive"
        notes.report(NON_POSITIVE_MASS, message, inertial.location, found=f"{mass:g}", expected="more than 0")
    if matrix is None or (mass == 0 and not any(matrix)):
        return
    if all(map(math.isfinite, matrix)):
        _check_moments(link, principal_moments(matrix), eps, inertial, notes)
    else:
        notes.report(INDEFINITE_INERTIA, f"the inertia of link {link!r} is not finite", inertial.location)


def _matrix(inertia: Inertia | None, format_: Format) -> Symmetric | None:
    """The elements with the format's defaults; None where one has no default."""
    if inertia is None:
        return None
    default = _DEFAULT_MOMENT[format_]
    xx, yy, zz = (default if value is None else value for value in (inertia.ixx, inertia.iyy, inertia.izz))
    if xx is None or yy is None or zz is None:
        return None
    return xx, yy, zz, inertia.ixy or 0.0, inertia.ixz or 0.0, inertia.iyz or 0.0


def _check_moments(
    link: str, moments: tuple[float, float, float], eps: float, inertial: Inertial, notes: Notes
) -> None:
    smallest, middle, largest = moments
    trace = sum(moments)
    if smallest <= _ROUNDING * abs(trace):
        listed = _list(moments)
        message = f"the inertia of link {link!r} is not positive definite: its principal moments are {listed}"
        notes.report(INDEFINITE_INERTIA, message, inertial.location, found=listed, expected="all more than 0")
    elif largest - smallest - middle > eps * trace:
        listed = _list(moments)
        message = (
            f"no body has the principal moments of link {link!r}, {listed}: the last exceeds the sum of the others"
        )
        notes.report(
            IMPOSSIBLE_INERTIA, message, inertial.location, found=listed, expected=f"at most {smallest + middle:.6g}"
        )


def _list(moments: tuple[float, ...]) -> str:
    return ", ".join(f"{moment:.6g}" for moment in moments)
