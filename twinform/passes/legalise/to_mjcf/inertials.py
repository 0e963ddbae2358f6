"""Inertials of MJCF: mass, center of mass, and moments of inertia in their own axes or in those of the body.

Also found here is what MuJoCo refuses: a body that moves and has no mass, and an inertia that no body can have.
"""

import math
from typing import NamedTuple

from twinform.diagnostics import Severity, rules
from twinform.ir import Element, Inertial, Link
from twinform.ir.defaults import MASS, MOMENT
from twinform.ir.document import Format
from twinform.ir.solids import Symmetric, principal_axes, principal_moments, tensor, turned
from twinform.ir.transform import Matrix3, Transform
from twinform.passes.carriers.mjcf_texts import Tagged
from twinform.passes.carriers.token_mass import TOKEN_MASS, TOKEN_MOMENT, has_token_mass, is_chain_token, says_zero
from twinform.passes.legalise.to_mjcf.elements import Value, make_element, orientation, position
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements, with_kept
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext
from twinform.schemas import format_value

MOST_FOR_NOTHING = 1e-15
"""`mjMINVAL`: MuJoCo takes a mass (kg) or a moment (kg m^2) that is not above it for none."""
# The digits that files have: what is impossible by less is an inertia whose last digits were cut off,
# or that was turned, and MuJoCo forgives not even 1e-16.
_CUT_OFF = 1e-9
_LEAST_OF_MATRIX = 2e-14
"""A little above `mjEPS`, in kg m^2: no eigenvalue of a matrix may be smaller."""
_CLEAR = 1e-12
"""How far the moments of a turned inertia are kept from the bound, as a part of their sum."""


class Weight(NamedTuple):
    """The mass of a link in kg, and its inertia in the axes of the inertial frame in kg m^2."""

    mass: float
    inertia: Symmetric

    @property
    def is_nothing(self) -> bool:
        """Whether it has neither mass nor inertia."""
        return self.mass == 0.0 and not any(self.inertia)

    @property
    def can_move(self) -> bool:
        """Whether MuJoCo lets a body of this weight move by itself."""
        # A matrix that is not finite has no eigenvalues, and was reported when it was read.
        if self.mass <= MOST_FOR_NOTHING or not all(map(math.isfinite, self.inertia)):
            return False
        moments = principal_moments(self.inertia) if any(self.inertia[3:]) else self.inertia[:3]
        return min(moments) > MOST_FOR_NOTHING


def weight_of(link: Link) -> Weight:
    """The mass and inertia of a link of SDF, by its defaults; tokens for a mass that the source lacks are zero."""
    inertial = link.inertial
    usual_mass, usual_moment = MASS[Format.SDF] or 0.0, MOMENT[Format.SDF] or 0.0
    if inertial is None:
        return Weight(usual_mass, (usual_moment, usual_moment, usual_moment, 0.0, 0.0, 0.0))
    mass = usual_mass if inertial.mass is None else inertial.mass
    inertia = tensor(inertial.inertia, usual_moment)
    if has_token_mass(inertial) or is_chain_token(inertial):
        mass = 0.0
    if inertial.inertia is not None and all(value in (0.0, TOKEN_MOMENT) for value in inertia):
        inertia = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return Weight(mass, inertia)


def weight_parts(inertial: Inertial) -> Tagged:
    """The mass, center and principal moments of an inertial, for a digest."""
    center = (inertial.pose and inertial.pose.xyz) or (0.0, 0.0, 0.0)
    moments = principal_moments(tensor(inertial.inertia, 0.0))
    numbers = {"mass": (inertial.mass or 0.0,), "center": center, "moments": moments}
    return "inertial", {name: " ".join(map(format_value, values)) for name, values in numbers.items()}


def has_usual_weight(link: Link) -> bool:
    """Whether a link has the mass and inertia that SDF gives to one that says nothing of them."""
    return weight_of(link) == weight_of(link.copy(inertial=None))


def inertial_elements(context: MjcfContext, body: Body) -> list[Element]:
    """The inertial of a body; none where its link has no mass."""
    link = body.link
    if link.inertial is not None and link.inertial.auto:
        message = f"the inertia of link {link.name!r} is left to be computed from its collisions, which is not possible"
        help_ = "write mass and inertia, or give it collisions that are closed"
        context.sink.report(rules.AUTOMATIC_INERTIA, message, link.inertial.location, help=help_)
        return []
    weight = weight_of(link)
    says_nothing = link.inertial is not None and (link.inertial.mass == 0.0 or says_zero(link.inertial))
    if weight.is_nothing and not says_nothing:
        return [each for each in kept_elements(link) if each.name == "inertial" and _is_massless(each)]
    # beside an inertia that was edited, since a body without any is read with a token
    if weight.mass == 0.0 and context.is_of_mjcf and not says_nothing:
        weight = weight._replace(mass=TOKEN_MASS)
    at = context.resolve(link.inertial.pose if link.inertial else None, body)
    inertia, axes = _in_writable_axes(_possible(context, link, weight.inertia))
    at = at if axes is None else at.compose(axes)
    attributes: list[tuple[str, Value]] = [("pos", position(at))]
    if any(inertia[3:]):
        # MuJoCo takes no orientation beside it.
        rest: list[tuple[str, Value]] = [("mass", weight.mass), ("fullinertia", turned(inertia, at))]
    else:
        turn: Value = None if at.is_unturned else orientation(at)
        rest = [("quat", turn), ("mass", weight.mass), ("diaginertia", inertia[:3])]
    source = link.inertial.source if link.inertial else None
    return [with_kept(make_element("inertial", [*attributes, *rest], (), source), link)]


def _is_massless(inertial: Element) -> bool:
    """Whether an inertial of MJCF has no mass; one that was given a mass has lost to what the link says."""
    return float(inertial.get("mass") or 0.0) <= MOST_FOR_NOTHING


def _in_writable_axes(inertia: Symmetric) -> tuple[Symmetric, Transform | None]:
    """The inertia of a tiny or thin body in its principal axes, with these; any other one as it is.

    MuJoCo refuses a full matrix with an eigenvalue that it takes for zero, but no principal moment of that size.
    """
    if not any(inertia[3:]) or not all(map(math.isfinite, inertia)):
        return inertia, None
    (a, b, c), (u, v, w) = principal_axes(inertia)
    if not 0.0 < min(a, b, c) < _LEAST_OF_MATRIX:
        return inertia, None
    axes: Matrix3 = (u[0], v[0], w[0], u[1], v[1], w[1], u[2], v[2], w[2])
    return (a, b, c, 0.0, 0.0, 0.0), Transform(rotation=axes)


def _possible(context: MjcfContext, link: Link, inertia: Symmetric) -> Symmetric:
    """The inertia, with last digits that MuJoCo accepts; one that is impossible by more is reported."""
    if not all(map(math.isfinite, inertia)) or not any(inertia):
        return inertia
    is_full = any(inertia[3:])
    least, middle, most = principal_moments(inertia) if is_full else sorted(inertia[:3])
    size = most + middle + abs(least)
    lacking = most - middle - least
    if least < -_CUT_OFF * size or (is_full and least <= 0.0 and lacking > _CUT_OFF * size):
        rule = rules.INDEFINITE_INERTIA
        message = f"link {link.name!r} has an inertia with a moment of {least:g} kg m^2, which MuJoCo refuses"
    elif lacking > _CUT_OFF * size:
        rule = rules.UNBALANCED_INERTIA
        message = (
            f"link {link.name!r} has moments of inertia of {least:g}, {middle:g} and {most:g} kg m^2, and MuJoCo "
            "refuses one that is more than the sum of the others"
        )
    else:
        return _with_clear_moments(inertia, lacking, size)
    where = link.inertial.location if link.inertial else link.location
    help_ = "balance-inertia writes the nearest inertia that a body can have, and --for mujoco runs it"
    context.sink.report(rule, message, where, help=help_, severity=Severity.ERROR)
    return inertia


def _with_clear_moments(inertia: Symmetric, lacking: float, size: float) -> Symmetric:
    """The inertia with its largest moment no more than the sum of the others, as MuJoCo computes them."""
    xx, yy, zz, xy, xz, yz = inertia
    if xy or xz or yz:
        # The same for all three moments turns no axis. MuJoCo computes them again, and rounds.
        more = max(0.0, lacking + _CLEAR * size)
        return (xx + more, yy + more, zz + more, xy, xz, yz)
    if lacking <= 0.0:
        return inertia
    return (min(xx, yy + zz), min(yy, xx + zz), min(zz, xx + yy), xy, xz, yz)


def report_weightless(context: MjcfContext, body: Body) -> None:
    """Report a body that moves by itself although neither it nor anything fixed to it has mass and inertia."""
    message = (
        f"link {body.name!r} moves, and neither it nor a link that is fixed to it has both mass and inertia: MuJoCo "
        "refuses such a model"
    )
    help_ = (
        "split-massless gives it a share of its neighbor's mass, fill-inertia the mass of its shapes; see --for mujoco"
    )
    context.sink.report(rules.MASSLESS_LINK, message, body.link.location, help=help_, severity=Severity.ERROR)
