"""Friction of collisions: the sliding, torsional and rolling coefficients of MJCF, and what SDF has for each of them.

In SDF, as ODE has it, a contact resists turning on the spot by the torque 3 pi / 16 a mu N, where a is the radius of
the contact, mu the torsional coefficient and N the normal force: so Hertz has it for a sphere, and Gazebo Classic's
tutorial on torsional friction for a contact. MuJoCo has one length for all but N. Where SDF asks for the radius of the
surface instead, a depends on how deep it is pressed in, and no length says that. Rolling has a length in both, in SDF
as a word of Bullet.

Of two coefficients of friction the lesser one counts in SDF; in MJCF it is the greater one, or that of the geom with
the higher priority.
"""

from collections.abc import Iterable, Mapping
from math import pi
from typing import NamedTuple

from twinform.ir import Collision, Element, Opaque, Surface
from twinform.ir.transform import rounded_number
from twinform.passes.legalise.to_mjcf.elements import numbers_in
from twinform.passes.legalise.to_mjcf.said_parts import child_number, child_text, untyped, without_elements
from twinform.schemas import format_value

USUAL_SLIDING = 1.0
"""The coefficient of what has none written, in SDF and in MJCF."""
USUAL_FRICTION = (USUAL_SLIDING, 0.005, 0.0001)
"""The three coefficients of a geom of MJCF that has none written."""
USUAL_CONDIM, TORSIONAL_CONDIM, ROLLING_CONDIM = 3, 4, 6
"""How many directions of a contact MuJoCo computes: with slipping alone, with turning, and with rolling."""
_HERTZ = 3 * pi / 16
_PATCH = "friction/torsional/patch_radius"
_ROLLING = "friction/bullet/rolling_friction"
_ORDER = ("coefficient", "use_patch_radius", "patch_radius", "surface_radius", "ode")


class Friction(NamedTuple):
    """The coefficients of a collision, of which the last two are lengths in m."""

    sliding: float
    torsional: float
    rolling: float

    @property
    def condim(self) -> int:
        """How many directions of a contact the coefficients are for."""
        if self.rolling > 0.0:
            return ROLLING_CONDIM
        return TORSIONAL_CONDIM if self.torsional > 0.0 else USUAL_CONDIM


def friction_of(collision: Collision) -> Friction:
    """The friction of a collision of SDF."""
    surface = collision.surface
    if surface is None:
        return Friction(USUAL_SLIDING, 0.0, 0.0)
    sliding = USUAL_SLIDING if surface.mu is None else surface.mu
    if not surface.opaque:
        return Friction(sliding, 0.0, 0.0)
    rolling = child_number(untyped_at(surface, "bullet", "friction"), "rolling_friction", default=0.0)
    return Friction(sliding, _length(untyped(surface, "torsional")), rolling)


def untyped_at(surface: Surface, name: str, at: str) -> Element | None:
    """The untyped element of a name in a part of a surface; friction and contacts have words of one name."""
    return next((part.element for part in surface.opaque if part.at == at and _is_called(part, name)), None)


def _is_called(part: Opaque, name: str) -> bool:
    return part.element is not None and part.element.name == name


def _length(torsional: Element | None) -> float:
    """What MuJoCo has for the torsional friction of SDF; 0 where it depends on the depth of a contact."""
    if (child_text(torsional, "use_patch_radius") or "true").strip() in {"false", "0"}:
        return 0.0
    radius = child_number(torsional, "patch_radius", default=0.0)
    return torsional_length(radius, child_number(torsional, "coefficient", default=1.0))


def torsional_length(radius: float, coefficient: float) -> float:
    """The torsional friction of MuJoCo, in m, for a contact of a radius and the coefficient of SDF."""
    return rounded_number(_HERTZ * radius * coefficient)


def torsional_part(length: float, rest: Element | None = None) -> Opaque:
    """The torsional friction of SDF for that of MuJoCo, with the rest of it that MuJoCo does not say."""
    factor = child_number(rest, "coefficient", default=1.0)
    if rest is None or factor <= 0.0:  # no radius would make it turn as hard as the file says
        rest, factor = Element.unchecked(name="torsional"), 1.0
    radius = format_value(rounded_number(length / _HERTZ / factor))
    parts = (Element.unchecked(name="patch_radius", text=radius), *rest.children)
    return Opaque.unchecked(
        at="friction", element=rest.copy(children=tuple(sorted(parts, key=lambda each: _ORDER.index(each.name))))
    )


def rolling_of(geom: Mapping[str, str]) -> float:
    """The rolling friction of a geom of MJCF, as far as its contacts have any."""
    numbers = numbers_in(geom.get("friction"))
    is_used = int(geom.get("condim", USUAL_CONDIM)) == ROLLING_CONDIM
    return (*numbers, *USUAL_FRICTION[len(numbers) :])[2] if is_used else 0.0


def with_rolling(surface: Surface, rolling: float) -> Surface:
    """The surface with another rolling friction; 0 takes it out."""

    def changed(element: Element) -> Element:
        is_it = element.name == "rolling_friction" and float(element.text or "0") != rolling
        children = tuple(map(changed, element.children))
        return element.copy(text=format_value(rolling)) if is_it else element.copy(children=children)

    if rolling <= 0.0:
        return without_elements(surface, {_ROLLING})
    parts = (
        part.copy(element=changed(part.element)) if part.at == "friction" and part.element else part
        for part in surface.opaque
    )
    return surface.copy(opaque=tuple(parts))


def without_friction(surface: Surface) -> Surface:
    """The surface without the untyped parts of it that a geom of MJCF says."""
    return without_elements(surface, {_PATCH}) if _length(untyped(surface, "torsional")) > 0.0 else surface


def friction_priorities(collisions: Iterable[Collision]) -> Mapping[Friction, int]:
    """The priority of each friction: the less the sliding one, the higher, so that the lesser of two counts.

    Of two that slide alike, the one that resists turning and rolling counts, as the radius of a contact does in ODE.
    That of the usual friction is 0, also against what other files have.
    """
    usual = Friction(USUAL_SLIDING, 0.0, 0.0)
    found = sorted({usual, *map(friction_of, collisions)}, key=lambda each: (-each.sliding, each[1:]))
    first = found.index(usual)
    return {each: place - first for place, each in enumerate(found)}
