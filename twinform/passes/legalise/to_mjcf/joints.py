"""Joints of MJCF: hinges, slides and balls of a body, with ranges, efforts, damping and springs; mimic as equality."""

from twinform.ir import Element
from twinform.ir.kinematic_tree import JointBetween
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext


def joint_elements(context: MjcfContext, body: Body, held_by: tuple[JointBetween, ...]) -> list[Element]:
    """The joints between a body and its parent, the nearest to the parent first; none for a fixed joint."""
    del context, body, held_by
    return []
