"""`twinform batch`: a folder of models. One file for each of its commands, imported when it is called."""

from collections.abc import Mapping

import click

from twinform.cli.lazy_group import LazyGroup

COMMANDS: Mapping[str, str] = {
    "convert": "Compile every model.",
    "check": "Find everything that is wrong with the models.",
    "diff": "Say which models of two folders are the same robots.",
    "stats": "Say in numbers what the models are made of.",
    "merge": "Put the results of several runs together.",
}
"""Every command and its summary."""


@click.command("batch", cls=LazyGroup, package=__name__, summaries=COMMANDS)
def command() -> None:
    """Work on every model of a folder, on several processors or machines.

    Each model is worked on in a process that may crash or hang without harm to the others.
    """
