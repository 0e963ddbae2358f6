"""`twinform fuel list`."""

import os
from pathlib import Path

import click

from twinform.cli.command import Command
from twinform.cli.printing import print_line
from twinform.compiler.packaging.fuel_cache import listed
from twinform.compiler.search.fuel import caches

EXAMPLES = {"Print what can be included by its address": "twinform fuel list"}


@click.command("list", cls=Command, examples=EXAMPLES)
@click.option(
    "--cache", type=click.Path(file_okay=False, path_type=Path), metavar="DIR", help="The cache; else those of Gazebo."
)
def command(cache: Path | None) -> None:
    """Print the addresses of all that is in the cache, in the newest version."""
    for name in listed((cache,) if cache else caches(os.environ)):
        print_line(name.uri)
