"""Contacts of MJCF: which geoms touch, how they slide, and the exclusions of the `contact` section."""

from collections.abc import Iterator

from twinform.ir import Collision
from twinform.passes.legalise.to_mjcf.contact_plan import USUAL, Bits, coefficient
from twinform.passes.legalise.to_mjcf.elements import Value, make_element
from twinform.passes.legalise.to_mjcf.kept_mjcf import kept_elements
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext


def touch_of(context: MjcfContext, body: Body, collision: Collision) -> list[tuple[str, Value]]:
    """The attributes of the geom of a collision that say what it touches and how: `contype`, `friction`, and so on."""
    return [*_bits(context, body, collision), *_friction(context, collision)]


def _bits(context: MjcfContext, body: Body, collision: Collision) -> Iterator[tuple[str, Value]]:
    """Yield the bits of a geom that are not the usual ones; those of a geom of MJCF stay as they were."""
    if context.contacts.kept_bits(body.name, collision) is not None:
        return
    bits = context.contacts.bits(body.name, collision)
    if bits != USUAL or any(_kept(collision, name) for name in Bits._fields):  # those that an edit has replaced
        yield "contype", str(bits.contype)
        yield "conaffinity", str(bits.conaffinity)


def _friction(context: MjcfContext, collision: Collision) -> Iterator[tuple[str, Value]]:
    """Yield the sliding friction, before the other two of a geom of MJCF, and the priority that makes it count."""
    others = tuple(map(float, _kept(collision, "friction").split()[1:]))
    if not others and (collision.surface is None or collision.surface.mu is None):
        return
    mu = coefficient(collision)
    yield "friction", (mu, *others)
    if not context.is_of_mjcf and (priority := context.friction_priorities[mu]):
        yield "priority", str(priority)


def _kept(collision: Collision, name: str) -> str:
    """The value of an attribute that a collision keeps of its geom; nothing where it keeps none."""
    return next((value for each in kept_elements(collision) if each.name == "geom" and (value := each.get(name))), "")


def add_contacts(context: MjcfContext) -> None:
    """Add the `contact` section: pairs and exclusions. All geoms have their names by now."""
    for pair in context.contacts.excluded:
        one, other = (context.written_bodies[link] for link in pair)
        context.add("contact", make_element("exclude", [("body1", one), ("body2", other)]))
