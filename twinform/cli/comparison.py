"""The options on how robots are compared."""

from collections.abc import Callable
from typing import Any, TypedDict, TypeVar

import click

from twinform.compiler.compare import TOLERANCE, ComparisonOptions

Command = TypeVar("Command", bound=Callable[..., Any])

_TOLERANCE = click.option(
    "--tolerance",
    type=click.FloatRange(min=0),
    default=TOLERANCE,
    show_default=True,
    help="The relative difference that counts as rounding; absolute for positions (m) and angles (rad).",
)
_CARRIERS = click.option(
    "--carriers/--no-carriers",
    "read_carriers",
    default=False,
    help="Whether what only carriers say counts as written, or is a difference of its own kind.",
)


class ComparisonFlags(TypedDict):
    """What these options give a command."""

    tolerance: float
    read_carriers: bool


def comparison_flags(command: Command) -> Command:
    """Give a command the options."""
    return _TOLERANCE(_CARRIERS(command))


def comparison_options(flags: ComparisonFlags) -> ComparisonOptions:
    """The options as the compiler takes them."""
    return ComparisonOptions(flags["tolerance"], flags["read_carriers"])
