"""The commands of `twinform fuel`."""

import os
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

import click

from twinform.cli.command import Command, Unusable
from twinform.cli.printing import print_line
from twinform.compiler.fuel_addresses import SERVER, caches
from twinform.compiler.packaging.fuel_cache import FuelError, add, listed, resources

_FOLDER = click.Path(file_okay=False, path_type=Path)


commands = click.Group("fuel")


@commands.command(
    "add",
    cls=Command,
    examples={
        "Put a model into the cache": "twinform fuel add crate --owner OpenRobotics",
        "Put all models of a folder there": "twinform fuel add models --owner OpenRobotics",
    },
)
@click.argument("folder", type=click.Path(exists=True, file_okay=False, path_type=Path))
@click.option("--owner", metavar="NAME", required=True, help="Whose models they are on the server.")
@click.option("--name", metavar="NAME", help="What the model is called there; else as its model.config says.")
@click.option("--resource-version", type=click.IntRange(min=1), metavar="N", help="Its version; else the next one.")
@click.option("--server", metavar="HOST", default=SERVER, help=f"The server; by default {SERVER}.")
@click.option("--cache", type=_FOLDER, metavar="DIR", help="The cache; else that of Gazebo.")
def add_models(
    folder: Path, owner: str, name: str | None, resource_version: int | None, server: str, cache: Path | None
) -> None:
    """Put model folders and worlds into the cache.

    FOLDER has a model.config, or is a folder of such folders; a folder with SDF files and no model.config is a world.
    Printed are the addresses by which they can be included. What is there already with the same files stays.
    """
    place = cache or caches(os.environ)[0]
    with _explain_errors(place):
        found = resources(folder)
    if name is not None and len(found) > 1:
        raise click.UsageError(f"--name is for one model, and {folder} has {len(found)}")
    for each in found:
        with _explain_errors(place):
            added = add(each, place, server, owner, name or each.name, resource_version)
        print_line(added.uri)


@contextmanager
def _explain_errors(place: Path) -> Generator[None]:
    """End the command with a message if a model cannot be read or has no place in the cache."""
    try:
        yield
    except FuelError as error:
        raise click.UsageError(str(error)) from error
    except OSError as error:
        raise Unusable(f"cannot write {error.filename or place}: {error.strerror}") from error


@commands.command(
    "list",
    cls=Command,
    examples={"Print what can be included by its address": "twinform fuel list"},
)
@click.option("--cache", type=_FOLDER, metavar="DIR", help="The cache; else those of Gazebo.")
def list_models(cache: Path | None) -> None:
    """Print the addresses of all that is in the cache, in the newest version."""
    for name in listed((cache,) if cache else caches(os.environ)):
        print_line(name.uri)
