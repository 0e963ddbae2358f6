"""Equalities of MJCF: joints that close a loop, which are no part of the tree (`context.tree.closing`)."""

from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext


def add_equalities(context: MjcfContext) -> None:
    """Add what closes loops to the `equality` section. All bodies and joints have their names by now."""
    del context
