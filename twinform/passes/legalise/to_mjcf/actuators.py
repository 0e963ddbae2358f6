"""Actuators of MJCF, from transmissions and ros2_control."""

from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext


def add_actuators(context: MjcfContext) -> None:
    """Add the `actuator` section. All joints have their names by now (`context.written_joints`)."""
    del context
