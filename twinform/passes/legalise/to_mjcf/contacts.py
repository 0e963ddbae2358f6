"""Contacts of MJCF: which geoms touch, how they slide, and the pairs and exclusions of the `contact` section."""

from twinform.ir import Collision
from twinform.passes.legalise.to_mjcf.elements import Value
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext


def touch_of(context: MjcfContext, body: Body, collision: Collision) -> list[tuple[str, Value]]:
    """The attributes of the geom of a collision that say what it touches and how: `contype`, `friction`, and so on."""
    del context, body, collision
    return []


def add_contacts(context: MjcfContext) -> None:
    """Add the `contact` section: pairs and exclusions. All geoms have their names by now."""
    del context
