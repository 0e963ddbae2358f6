"""`twinform batch`: a folder of models."""

import click

from twinform.cli.command import LazyGroup

COMMANDS = {
    "convert": "Compile every model.",
    "check": "Find everything that is wrong with the models.",
    "diff": "Say which models of two folders are the same robots.",
    "stats": "Say in numbers what the models are made of.",
    "merge": "Put the results of several runs together.",
}
"""Every command and its summary."""


def _load() -> click.Group:
    from twinform.cli.batch_commands import commands  # noqa: PLC0415 - with them comes the compiler

    return commands


@click.command("batch", cls=LazyGroup, summaries=COMMANDS, load=_load)
def command() -> None:
    """Work on every model of a folder, on several processors or machines.

    Each model is worked on in a process that may crash or hang without harm to the others.
    """
