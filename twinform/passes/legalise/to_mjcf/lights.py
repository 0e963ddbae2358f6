"""Lights of MJCF: those of links, and those of the world."""

from twinform.ir import Element
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext


def body_lights(context: MjcfContext, body: Body) -> list[Element]:
    """The lights of a link."""
    del context, body
    return []


def world_lights(context: MjcfContext) -> list[Element]:
    """The lights of a world, or those beside the models of a document."""
    del context
    return []
