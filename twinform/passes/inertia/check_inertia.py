"""Check that bodies which move have a mass and an inertia that a body can have."""

from collections.abc import Mapping
from typing import ClassVar, Self

from pydantic import Field, model_validator

from twinform.diagnostics import DiagnosticSink, Severity
from twinform.diagnostics.rules import MASS_RATIO, MISSING_INERTIAL, NON_POSITIVE_MASS
from twinform.ir import Document, Format, Inertial, Link
from twinform.ir.defaults import MOMENT
from twinform.ir.verify.verify_bodies import inertia_matrix, report_moments
from twinform.passes.framework.pass_base import AssetPass
from twinform.passes.inertia.physical_consistency import DIGITS, ROUNDING, PlausibilityCheck
from twinform.passes.shared.link_shapes import (
    ShapePlaces,
)
from twinform.passes.shared.mesh_solids import Meshes
from twinform.passes.shared.moving_bodies import Body, ConnectedBodies, movable_models, moving_bodies, neighbors


class CheckInertia(AssetPass):
    """Find masses and inertias that no moving body can have, or that none is likely to have.

    Changes nothing.
    Diagnostics, at the `<inertial>` of a link, or at the link where it has none:

    1. `missing-inertial`: in URDF a body, that is links held together by fixed joints, of which no link has an
       `<inertial>`; in SDF a link without one;
    2. `non-positive-mass`: a mass of zero or less;
    3. `indefinite-inertia`: a principal moment of zero or less;
    4. `impossible-inertia`: a principal moment that is larger than the sum of the other two;
    5. `distant-centre-of-mass`: a center of mass outside of the box around the link's shapes;
    6. `oversized-inertia`: moments that the mass cannot have within that box;
    7. `implausible-density`: a mass that is too small or too large for the volume of the shapes;
    8. `mass-ratio`, at the joint: two bodies of which one weighs more than `ratio` times as much as the other.

    Never looks at: what cannot move (static models, and links that fixed joints hold to the world), inertias that
    the simulator computes (`auto`), and models that an `<include>` names. 5 to 7 are left out for links with a mesh
    unless `meshes=true`, and with shapes that have no ends.
    """

    name = "check-inertia"
    example: ClassVar[str] = "check-inertia{eps=0.001 meshes=true}"

    eps: float = Field(
        default=DIGITS,
        ge=0,
        lt=1,
        allow_inf_nan=False,
        description="How far the largest principal moment may exceed the sum of the others, as a part of the trace: "
        "files round.",
    )
    least_density: float = Field(
        default=1.0, ge=0, allow_inf_nan=False, description="The least plausible density, in kg/m^3."
    )
    greatest_density: float = Field(
        default=23000.0, gt=0, description="The greatest plausible density, in kg/m^3; `inf` for none."
    )
    ratio: float = Field(
        default=100.0, ge=1, description="The greatest ratio of the masses of neighbors; `inf` for any."
    )
    meshes: bool = Field(
        default=False, description="Whether meshes are looked into as well; it needs `pip install 'twinform[meshes]'`."
    )

    @model_validator(mode="after")
    def _check_densities(self) -> Self:
        if not self.least_density <= self.greatest_density:
            raise ValueError("least-density is above greatest-density")
        return self

    def run(self, document: Document, sink: DiagnosticSink) -> Document:
        """The same document."""
        bodies = moving_bodies(document)
        for body in bodies:
            _check_presence(body, document.format, sink)
            for link in body:
                if link.inertial and not link.inertial.auto:
                    _check_inertial(link, link.inertial, document.format, self.eps, sink)
        self._check_shapes(document, {id(link) for body in bodies for link in body}, sink)
        masses = {id(body[0]): _body_mass(body) for body in bodies}
        for each in neighbors(document):
            _check_ratio(each, masses, self.ratio, sink)
        return document

    def _check_shapes(self, document: Document, moving: set[int], sink: DiagnosticSink) -> None:
        meshes = Meshes(self._assets) if self.meshes else None
        densities = (self.least_density, self.greatest_density)
        for model in movable_models(document):
            check = PlausibilityCheck(ShapePlaces(model), meshes, densities, MOMENT[document.format], sink)
            for link in model.links:
                if id(link) in moving and link.inertial and not link.inertial.auto:
                    check.link(link, link.inertial)


def _check_presence(body: Body, format_: Format, sink: DiagnosticSink) -> None:
    if format_ is Format.SDF:
        for link in body:
            if link.inertial is None:
                message = f"link {link.name!r} moves but has no <inertial>; simulators take 1 kg and 1 kg m^2"
                sink.report(MISSING_INERTIAL, message, link.location, expected="<inertial>")
    elif not any(link.inertial for link in body):
        first, *others = body
        joined = f", nor has any of the {len(others)} fixed to it" if others else ""
        message = f"link {first.name!r} moves but has no <inertial>{joined}"
        related = tuple(link.location for link in others)
        sink.report(MISSING_INERTIAL, message, first.location, expected="<inertial>", related=related)


def _check_inertial(link: Link, inertial: Inertial, format_: Format, eps: float, sink: DiagnosticSink) -> None:
    mass, matrix = inertial.mass, inertia_matrix(inertial.inertia, MOMENT[format_])
    if mass is not None and not mass > 0 and not sink.has(NON_POSITIVE_MASS, inertial.location, Severity.WARNING):
        message = f"the mass of link {link.name!r}, which moves, is {mass:g}; it has to be positive"
        sink.report(NON_POSITIVE_MASS, message, inertial.location, found=f"{mass:g}", expected="more than 0")
    # A link with neither mass nor inertia is a frame to its author.
    if matrix is not None and (mass != 0 or any(matrix)):
        report_moments(link, inertial, matrix, eps, sink, least=ROUNDING)


def _check_ratio(each: ConnectedBodies, masses: Mapping[int, float], limit: float, sink: DiagnosticSink) -> None:
    """Compare the masses of two bodies, which are known by the identity of their first links."""
    weights = [masses.get(id(body[0]), 0.0) if body else 0.0 for body in (each.parent, each.child)]
    light, heavy = sorted(weights)
    if not light > 0 or not heavy / light > limit:
        return
    ends = zip((each.parent, each.child), weights, strict=True)
    words = " and ".join(f"{body[0].name!r} with {mass:.4g} kg" for body, mass in ends)
    message = f"joint {each.joint.name!r} connects {words}: at {heavy / light:.3g} to 1, simulations may get unstable"
    found, expected = f"{heavy / light:.4g}", f"at most {limit:g}"
    sink.report(MASS_RATIO, message, each.joint.location, found=found, expected=expected)


def _body_mass(body: Body) -> float:
    """The mass of a body, in kg; zero where none is written."""
    return sum(link.inertial.mass or 0.0 for link in body if link.inertial)
