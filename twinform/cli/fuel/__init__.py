"""`twinform fuel`: the local cache of Gazebo Fuel. One file for each of its commands, imported when it is called."""

from collections.abc import Mapping

import click

from twinform.cli.lazy_group import LazyGroup

COMMANDS: Mapping[str, str] = {
    "add": "Put model folders and worlds into the cache.",
    "list": "Print the addresses of all that is in the cache.",
}
"""Every command and its summary."""


@click.command("fuel", cls=LazyGroup, package=__name__, summaries=COMMANDS)
def command() -> None:
    """Fill the local cache of Gazebo Fuel.

    Includes by address are looked up there, and nothing is fetched from a network. The cache is where Gazebo has it:
    GZ_FUEL_CACHE_PATH, or .gz/fuel in the home.
    """
