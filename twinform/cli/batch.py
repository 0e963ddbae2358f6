"""`twinform batch`: a folder of models."""

import click

COMMANDS = {
    "convert": "Compile every model.",
    "check": "Find everything that is wrong with the models.",
    "diff": "Say which models of two folders are the same robots.",
    "stats": "Say in numbers what the models are made of.",
    "merge": "Put the results of several runs together.",
}
"""Every command and its summary."""


class _BatchGroup(click.Group):
    """Imports the commands, and with them the compiler, when one is called: the help needs only their summaries."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names, in the order of the help."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import a command."""
        from twinform.cli.batch_commands import commands  # noqa: PLC0415 - see above

        return commands.get_command(ctx, cmd_name)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the summaries, without importing a command."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))


@click.command("batch", cls=_BatchGroup)
def command() -> None:
    """Work on every model of a folder, on several processors or machines.

    Each model is worked on in a process that may crash or hang without harm to the others.
    """
