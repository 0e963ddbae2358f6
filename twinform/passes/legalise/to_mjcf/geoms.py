"""Geoms of MJCF: the collisions of a link, which touch, and its visuals, which are only seen."""

from twinform.ir import Element
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext


def geom_elements(context: MjcfContext, body: Body) -> list[Element]:
    """The geoms of a body: its collisions and then its visuals."""
    del context, body
    return []
