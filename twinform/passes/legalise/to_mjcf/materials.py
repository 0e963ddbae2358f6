"""Colors, materials and textures of visuals."""

from twinform.ir import Visual
from twinform.passes.legalise.to_mjcf.elements import Value
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext


def look_of(context: MjcfContext, body: Body, visual: Visual) -> list[tuple[str, Value]]:
    """The attributes of the geom of a visual that say how it looks: `rgba`, or the name of a material in `asset`."""
    del context, body, visual
    return []
