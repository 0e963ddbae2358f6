"""Sites of MJCF: the named frames of SDF, each in the body that it moves with."""

from twinform.ir import Element
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext


def body_sites(context: MjcfContext, body: Body) -> list[Element]:
    """The sites for the named frames that move with a link."""
    del context, body
    return []


def world_sites(context: MjcfContext) -> list[Element]:
    """The sites for the named frames that stand still in the world."""
    del context
    return []
