"""Options of MJCF: time step, gravity, wind, and what is seen of a world."""

from twinform.passes.legalise.to_mjcf.writing_context import MjcfContext


def add_options(context: MjcfContext) -> None:
    """Add what a world says of its physics to the sections `option`, `visual` and `statistic`."""
    del context
