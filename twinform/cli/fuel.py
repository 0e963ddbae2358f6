"""`twinform fuel`: the local cache of Gazebo Fuel."""

import click

from twinform.cli.command import LazyGroup

COMMANDS = {
    "add": "Put model folders and worlds into the cache.",
    "list": "Print the addresses of all that is in the cache.",
}
"""Every command and its summary."""


def _load() -> click.Group:
    from twinform.cli.fuel_commands import commands  # noqa: PLC0415 - with them comes the compiler

    return commands


@click.command("fuel", cls=LazyGroup, summaries=COMMANDS, load=_load)
def command() -> None:
    """Fill the local cache of Gazebo Fuel.

    Includes by address are looked up there, and nothing is fetched from a network. The cache is where Gazebo has it:
    GZ_FUEL_CACHE_PATH, or .gz/fuel in the home.
    """
