"""Contacts of MJCF: which geoms touch, how they slide, turn and roll, and the exclusions of the `contact` section."""

from collections.abc import Iterator

from twinform.diagnostics import rules
from twinform.ir import Collision
from twinform.passes.legalise.to_mjcf.contact_plan import USUAL, Bits
from twinform.passes.legalise.to_mjcf.elements import Value, make_element
from twinform.passes.legalise.to_mjcf.friction import (
    ROLLING_CONDIM,
    TORSIONAL_CONDIM,
    USUAL_CONDIM,
    USUAL_FRICTION,
    Friction,
    friction_of,
    without_friction,
)
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_of_geom
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext

_CONDIMS = frozenset({0, 1, USUAL_CONDIM, TORSIONAL_CONDIM, ROLLING_CONDIM})
"""The numbers of directions that MuJoCo takes; 0 stands for none written."""


def touch_of(context: MjcfContext, body: Body, collision: Collision) -> list[tuple[str, Value]]:
    """The attributes of the geom of a collision that say what it touches and how: `contype`, `friction`, and so on."""
    return [*_bits(context, body, collision), *_friction(context, collision)]


def _bits(context: MjcfContext, body: Body, collision: Collision) -> Iterator[tuple[str, Value]]:
    """Yield the bits of a geom that are not the usual ones; those of a geom of MJCF stay as they were."""
    if context.contacts.kept_bits(body.name, collision) is not None:
        return
    bits = context.contacts.bits(body.name, collision)
    if bits != USUAL or any(kept_of_geom(collision, name) for name in Bits._fields):  # those that an edit has replaced
        yield "contype", str(bits.contype)
        yield "conaffinity", str(bits.conaffinity)


def _friction(context: MjcfContext, collision: Collision) -> Iterator[tuple[str, Value]]:
    """Yield the friction, for how many directions it is, and the priority that makes it count."""
    if collision.surface is None and not collision.opaque:  # as most, and then all is usual
        return
    friction, surface = friction_of(collision), collision.surface
    numbers = (friction.sliding, *_lengths(collision, friction))
    if len(numbers) > 1 or (surface is not None and surface.mu is not None):
        yield "friction", numbers
    kept = _kept_condim(collision)
    if kept not in _CONDIMS:
        message = f"a contact has 1, 3, 4 or 6 directions, and collision {collision.name!r} keeps a condim of {kept}"
        context.sink.report(rules.STALE_CARRIER, message, collision.location, found=str(kept))
    if friction.condim > max(kept, USUAL_CONDIM) or kept not in _CONDIMS:
        yield "condim", str(friction.condim)
    is_edited = bool(kept_of_geom(collision, "priority"))  # in the file of MJCF that it has been
    if not (context.is_of_mjcf or is_edited) and (priority := context.friction_priorities[friction]):
        yield "priority", str(priority)
    if surface is not None and not context.is_of_mjcf and (left := without_friction(surface)) is not surface:
        context.leave(surface, left)


def _lengths(collision: Collision, friction: Friction) -> tuple[float, ...]:
    """The torsional and rolling friction of a geom, as far as they are not the usual ones.

    A geom of MJCF keeps the one that rolls, and the one that turns where its `condim` leaves that out.
    """
    _, *kept = map(float, kept_of_geom(collision, "friction").split() or ("0",))
    _, torsional, rolling = (friction.sliding, *kept, *USUAL_FRICTION[1 + len(kept) :])
    if friction.condim > USUAL_CONDIM or _kept_condim(collision) > USUAL_CONDIM:
        torsional = friction.torsional
    found = (torsional, friction.rolling or rolling)
    needed = max((place for place in (1, 2) if found[place - 1] != USUAL_FRICTION[place]), default=0)
    return found[: max(needed, len(kept))]


def _kept_condim(collision: Collision) -> int:
    return int(kept_of_geom(collision, "condim") or "0")


def add_contacts(context: MjcfContext) -> None:
    """Add the `contact` section: pairs and exclusions. All geoms have their names by now."""
    for pair in context.contacts.excluded:
        one, other = (context.written_bodies[link] for link in pair)
        context.add("contact", make_element("exclude", [("body1", one), ("body2", other)]))
