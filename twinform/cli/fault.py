"""How a command ends where a pass is at fault that nobody asked for, such as those that comparisons run."""

import click

from twinform.cli.failure import UNUSABLE
from twinform.cli.instrumentation import show_fault
from twinform.passes import PassError


def end_with(error: Exception, ctx: click.Context) -> None:
    """Say what a pass did wrong, and end; any other exception is not for here."""
    if isinstance(error, PassError):
        show_fault(error, f"twinform {ctx.invoked_subcommand}")
        ctx.exit(UNUSABLE)
