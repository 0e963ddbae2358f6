"""Sensors of MJCF, and the sites and cameras that they are on.

What belongs into the `sensor` section is added to the context (`context.add("sensor", element)`).
"""

from twinform.ir import Element
from twinform.ir.kinematic_tree import JointBetween
from twinform.passes.legalise.to_mjcf.writing_context import Body, MjcfContext


def body_sensors(context: MjcfContext, body: Body) -> list[Element]:
    """The sites and cameras of a body, for the sensors of its link."""
    del context, body
    return []


def joint_sensors(context: MjcfContext, body: Body, held_by: JointBetween) -> list[Element]:
    """The sites for sensors on a joint, in the body that it holds."""
    del context, body, held_by
    return []
